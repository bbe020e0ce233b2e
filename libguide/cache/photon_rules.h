#pragma once
// Which photons a training takes, and what it does with them.

#include "libguide/cache/block_trainer.h"
#include "libguide/cache/medium_tree.h"
#include "libguide/cache/training_tree.h"
#include "libguide/records/photon.h"

namespace waylight {

struct SurfaceRules {
  Bounds accepted;
  float emitted = 1;
  Quantity quantity = Quantity::radiance;
  TreeOptions tree;
  CellTrainingOptions cell;

  PhotonVerdict judge(const Photon& photon) const;
  PhotonVerdict judge(const Escape& escape) const;
};

struct MediumRules {
  Bounds accepted;
  float emitted = 1;
  MediumTreeOptions tree;
  MediumCellOptions cell;

  PhotonVerdict judge(const MediumPhoton& photon) const;
};

// The bounds of a scene with room for what rounding leaves outside.
Bounds accepted_bounds(Bounds scene);

}  // namespace waylight
