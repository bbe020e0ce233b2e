#pragma once
// *.cache: illumination caches. Schema cache.fbs, identifier "WCCH".

#include <memory>
#include <string>

#include "formats/provenance.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/records/guide_cache.h"

namespace waylight {

struct CacheFile {
  Provenance provenance;
  GuideCache cache;
};

void write_cache(const std::string& path, const CacheFile& file);
// The whole cache in memory, training statistics included: for training and reduction.
CacheFile read_cache(const std::string& path);

// A cache in use: its bulk stays in the memory-mapped file. Verified and checked when opened.
class MappedCache {
 public:
  explicit MappedCache(const std::string& path);
  ~MappedCache();
  MappedCache(MappedCache&&) noexcept;

  const Provenance& provenance() const;
  GuideCacheView view() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace waylight
