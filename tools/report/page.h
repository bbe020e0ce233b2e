#pragma once
// The page: its template, filled with sections for the scenes.

#include "tools/report/reach.h"
#include "tools/report/report_tool.h"

namespace waylight {

std::string report_page(const std::vector<SceneRuns>& scenes, const ReportOptions& options,
                        const ToolRun& run);

// The section of a table of pipelines/stability.mk; empty without a path. Throws Error naming the
// file where it is none.
std::string stability_section(const std::string& path);

// page.html, page.css and page.js of this folder, embedded by CMake.
extern const char* const kPageHtml;
extern const char* const kPageCss;
extern const char* const kPageJs;

}  // namespace waylight
