#pragma once
// *.brdf: fitted BSDFs. Schema brdf.fbs, identifier "WBRF".

#include <string>

#include "formats/provenance.h"
#include "libguide/records/brdf_cache.h"

namespace waylight {

struct BrdfFile {
  Provenance provenance;
  BrdfCache cache;
};

void write_brdf(const std::string& path, const BrdfFile& file);
// Verifies and checks meaning (finite values, indices in range); throws Error naming the file.
BrdfFile read_brdf(const std::string& path);

}  // namespace waylight
