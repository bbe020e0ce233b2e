// The only translation unit that sees OpenVDB, but for a test: its headers cost 12 s and 0.9 GB to
// compile.

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <sstream>

#include "formats/atomic_file.h"
#include "formats/content_hash.h"
#include "formats/file_bytes.h"
#include "formats/volume_checks.h"
#include "formats/volume_io.h"

namespace waylight {
namespace {

// OpenVDB does not look whether the file ends before its grids do, and would leave what it missed
// as it was: the stream throws then.
openvdb::GridPtrVecPtr read_grids(const std::string& path) {
  std::istringstream bytes(read_whole_file(path));
  bytes.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
  return openvdb::io::Stream(bytes, /*delayLoad=*/false).getGrids();
}

const openvdb::GridBase& choose_grid(const openvdb::GridPtrVec& grids, const std::string& path,
                                     const std::string& gridname) {
  if (grids.empty()) fail("\"{}\": there is no grid in it", path);
  if (gridname.empty() && grids.size() == 1) return *grids[0];
  const std::string wanted = gridname.empty() ? "density" : gridname;
  std::vector<std::string> names;
  for (const openvdb::GridBase::Ptr& grid : grids) {
    names.push_back(grid->getName());
    if (names.back() == wanted) return *grid;
  }
  fail("\"{}\": there is no grid \"{}\"; it holds: {}", path, wanted, fmt::join(names, ", "));
}

// [0,1]^3 of the dense grid -> index space -> world. OpenVDB multiplies row vectors, and the centre
// of voxel (i, j, k) is at the integers: i = g n + min - 0.5.
Mat4 grid_to_world(const openvdb::GridBase& grid, const openvdb::CoordBBox& box,
                   const std::string& path) {
  if (!grid.transform().isLinear())
    fail("\"{}\": grid \"{}\" has a frustum transform; resample it to a linear one", path,
         grid.getName());
  const openvdb::math::Mat4d rows = grid.transform().baseMap()->getAffineMap()->getMat4();
  Eigen::Matrix4d index_to_world, grid_to_index = Eigen::Matrix4d::Identity();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) index_to_world(i, j) = rows(j, i);
  for (int axis = 0; axis < 3; ++axis) {
    grid_to_index(axis, axis) = box.dim()[axis];
    grid_to_index(axis, 3) = box.min()[axis] - 0.5;
  }
  const Mat4 to_world = (index_to_world * grid_to_index).cast<float>();
  if (!to_world.allFinite() || !(std::abs(index_to_world.determinant()) > 0))
    fail("\"{}\": grid \"{}\" has a singular transform", path, grid.getName());
  return to_world;
}

// The voxels of a box of index space. A node of the tree that is missing is a tile of one value, or
// background.
template <typename Grid, typename DenseValue>
class GridVoxels : public VoxelSource {
 public:
  GridVoxels(const Grid& grid, const openvdb::Coord& origin)
      : tree_(grid.tree()), voxels_(grid.getConstAccessor()), origin_(origin) {}

  bool constant(const VoxelBox& box, float* value) const override {
    return box.extent().maxCoeff() > kLeafSide + 1 ? one_tile<Node>(box, value)
                                                   : one_tile<Leaf>(box, value);
  }
  void read(const VoxelBox& box, float* values) const override {
    openvdb::tools::Dense<DenseValue, openvdb::tools::LayoutXYZ> dense(
        openvdb::CoordBBox(index(box.first), index(box.last)),
        reinterpret_cast<DenseValue*>(values));
    openvdb::tools::copyToDense(tree_, dense, /*serial=*/true);
  }

 private:
  using Tree = typename Grid::TreeType;
  using Leaf = typename Tree::LeafNodeType;
  using Node = typename Tree::RootNodeType::ChildNodeType::ChildNodeType;
  static constexpr int kLeafSide = 8;
  static_assert(Leaf::DIM == kLeafSide && Node::DIM == 128);

  openvdb::Coord index(const Eigen::Vector3i& voxel) const {
    return origin_ + openvdb::Coord(voxel.x(), voxel.y(), voxel.z());
  }
  // All nodes that a box meets have one of its corners: it is wider by one voxel at most.
  template <typename AnyNode>
  bool one_tile(const VoxelBox& box, float* value) const {
    const auto first = static_cast<DenseValue>(voxels_.getValue(index(box.first)));
    for (int corner = 0; corner < 8; ++corner) {
      const openvdb::Coord at =
          index({(corner & 1 ? box.last : box.first).x(), (corner & 2 ? box.last : box.first).y(),
                 (corner & 4 ? box.last : box.first).z()});
      if (voxels_.template probeConstNode<AnyNode>(at)) return false;
      if (static_cast<DenseValue>(voxels_.getValue(at)) != first) return false;
    }
    std::memcpy(value, &first, sizeof(first));
    return true;
  }

  const Tree& tree_;
  typename Grid::ConstAccessor voxels_;
  openvdb::Coord origin_;
};

template <typename DenseValue = float, typename Grid>
VoxelBricks to_bricks(const Grid& grid, const openvdb::CoordBBox& box, const std::string& path) {
  const Eigen::Vector3i size(box.dim().x(), box.dim().y(), box.dim().z());
  return checked_bricks(path, size, sizeof(DenseValue) / sizeof(float),
                        GridVoxels<Grid, DenseValue>(grid, box.min()));
}

openvdb::CoordBBox active_box(const openvdb::GridBase& grid, const std::string& path) {
  openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) box = openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(0));
  const auto extent = [&](int axis) { return int64_t{box.max()[axis]} - box.min()[axis] + 1; };
  check_volume_size(path, extent(0), extent(1), extent(2));
  return box;
}

// Distances to a surface would pass for density outside it, and for nothing inside.
void refuse_level_set(const openvdb::GridBase& grid, const std::string& path) {
  if (grid.getGridClass() == openvdb::GRID_LEVEL_SET)
    fail(
        "\"{}\": grid \"{}\" is a level set, whose values are distances; convert it to a fog "
        "volume (openvdb::tools::sdfToFogVolume, or vdb_tool -read IN.vdb -ls2fog -write OUT.vdb)",
        path, grid.getName());
}

VolumeGrid to_volume(const openvdb::GridBase& grid, const std::string& path) {
  refuse_level_set(grid, path);
  const openvdb::CoordBBox box = active_box(grid, path);
  const Mat4 to_world = grid_to_world(grid, box, path);
  if (const auto* floats = dynamic_cast<const openvdb::FloatGrid*>(&grid))
    return {to_bricks(*floats, box, path), false, to_world};
  if (const auto* doubles = dynamic_cast<const openvdb::DoubleGrid*>(&grid))
    return {to_bricks(*doubles, box, path), false, to_world};
  if (const auto* vectors = dynamic_cast<const openvdb::Vec3SGrid*>(&grid))
    return {to_bricks<openvdb::Vec3s>(*vectors, box, path), false, to_world};
  fail("\"{}\": grid \"{}\" holds values of type {}; float, double or vec3s is needed", path,
       grid.getName(), grid.valueType());
}

// The inverse of grid_to_world(): voxel (i, j, k) is centred at the integers.
openvdb::math::Transform::Ptr transform_of(const VolumeGrid& grid) {
  Eigen::Matrix4d index_to_grid = Eigen::Matrix4d::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    index_to_grid(axis, axis) = 1.0 / grid.size()[axis];
    index_to_grid(axis, 3) = 0.5 / grid.size()[axis];
  }
  const Eigen::Matrix4d index_to_world = grid.grid_to_world.cast<double>() * index_to_grid;
  openvdb::math::Mat4d rows;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) rows(j, i) = index_to_world(i, j);
  return openvdb::math::Transform::createLinearTransform(rows);
}

openvdb::FloatGrid::Ptr to_sparse(const VolumeGrid& grid) {
  openvdb::FloatGrid::Ptr sparse = openvdb::FloatGrid::create(0);
  openvdb::FloatGrid::Accessor voxels = sparse->getAccessor();
  const VoxelBox all{Eigen::Vector3i::Zero(), grid.size() - Eigen::Vector3i::Ones()};
  for_each_voxel(all, [&](const Eigen::Vector3i& i) {
    const float value = *grid.voxels.at(i);
    if (value != 0) voxels.setValue({i.x(), i.y(), i.z()}, value);
  });
  sparse->setTransform(transform_of(grid));
  sparse->setGridClass(openvdb::GRID_FOG_VOLUME);
  return sparse;
}

// Every file has a UUID after its magic number, versions and a flag, by OpenVDB the clock's; here
// it is the hash of the rest.
void replace_uuid(std::string& bytes) {
  constexpr size_t kAt = 8 + 3 * 4 + 1;
  const std::string blank = "00000000-0000-0000-0000-000000000000";
  bytes.replace(kAt, blank.size(), blank);
  ContentHash hash;
  hash.add(bytes);
  const std::string digits = fmt::format("{:016x}", hash.value());
  bytes.replace(kAt + 19, 4, digits, 0, 4);
  bytes.replace(kAt + 24, 12, digits, 4, 12);
}

}  // namespace

VolumeGrid read_vdb(const std::string& path, const std::string& gridname) {
  try {
    openvdb::initialize();
    const openvdb::GridPtrVecPtr grids = read_grids(path);
    return to_volume(choose_grid(*grids, path, gridname), path);
  } catch (const Error&) {
    throw;
  } catch (const std::ios::failure&) {
    fail("\"{}\": is truncated, or no OpenVDB file", path);
  } catch (const std::exception& e) {
    fail("\"{}\": cannot be read as OpenVDB: {}", path, e.what());
  }
}

void write_vdb(const std::string& path, const VolumeGrid& grid, const std::string& gridname,
               const std::map<std::string, std::string>& metadata) {
  if (grid.voxels.channels() != 1)
    fail("\"{}\": a grid of {} channels cannot be written", path, grid.voxels.channels());
  openvdb::initialize();
  const openvdb::FloatGrid::Ptr sparse = to_sparse(grid);
  sparse->setName(gridname);
  for (const auto& [name, text] : metadata) sparse->insertMeta(name, openvdb::StringMetadata(text));
  write_atomically(path, [&](const std::string& temporary) {
    openvdb::io::File(temporary).write(openvdb::GridCPtrVec{sparse});
    std::string bytes = read_whole_file(temporary);
    replace_uuid(bytes);
    write_whole_file(temporary, bytes);
  });
}

}  // namespace waylight
