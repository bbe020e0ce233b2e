#pragma once
// The records of caches that are stored as they are.

#include "formats/cache_generated.h"
#include "formats/flat_file.h"
#include "formats/flat_records.h"
#include "libguide/records/guide_cache.h"

namespace waylight {

FLAT_RECORD(CacheNode, fbs::CacheNode);
FLAT_RECORD(CacheCell, fbs::CacheCell);
FLAT_RECORD(CellReach, fbs::Bounds);
FLAT_RECORD(ComponentStatistics, fbs::ComponentStatistics);
FLAT_RECORD(CellTraining, fbs::CellTraining);
FLAT_RECORD(CellSources, fbs::CellSources);
static_assert(offsetof(CacheCell, irradiance) == 12 && offsetof(CacheCell, component_count) == 32);
static_assert(offsetof(CellTraining, flux) == 64 && offsetof(CellTraining, weight_sum) == 96);

FLAT_RECORD(VmfComponent, fbs::VmfComponent);
FLAT_RECORD(VmfStatistics, fbs::VmfStatistics);
FLAT_RECORD(MediumCell, fbs::MediumCell);
FLAT_RECORD(MediumTraining, fbs::MediumTraining);
FLAT_RECORD(FocusedLobe, fbs::FocusedLobe);
FLAT_RECORD(FocusedCell, fbs::FocusedCell);
static_assert(offsetof(FocusedLobe, size) == 16 && offsetof(FocusedCell, lobe_count) == 8);
static_assert(offsetof(VmfComponent, kappa) == 16 && offsetof(MediumCell, direct) == 20);
static_assert(offsetof(MediumLight, component_count) == 16);
static_assert(offsetof(MediumTraining, born) == 40 && offsetof(MediumTraining, direct) == 96);
static_assert(offsetof(MediumLightTraining, weight_sum) == 16);

}  // namespace waylight
