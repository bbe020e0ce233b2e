#pragma once
// The part of a cache file that is of media.

#include <string>

#include "formats/cache_records.h"
#include "libguide/cache/medium_cache_view.h"

namespace waylight {

// Null where there is nothing to store: a cache without media keeps the bytes that it had before
// there was this part.
struct MediumPart {
  template <typename Flat>
  using Records = flatbuffers::Offset<flatbuffers::Vector<const Flat*>>;

  Records<fbs::CacheNode> nodes;
  Records<fbs::MediumCell> cells;
  Records<fbs::VmfComponent> components;
  Records<fbs::VmfStatistics> statistics;
  Records<fbs::MediumTraining> training;
  Records<fbs::FocusedCell> focused_cells;
  Records<fbs::FocusedLobe> focused_lobes;
};

size_t medium_bytes(const MediumCache& medium);
MediumPart add_medium(flatbuffers::FlatBufferBuilder& builder, const MediumCache& medium);

// Not checked yet.
MediumCacheView medium_view_of(const fbs::GuideCache& root, const std::string& path);
MediumCache medium_copy_of(const fbs::GuideCache& root, const std::string& path);

}  // namespace waylight
