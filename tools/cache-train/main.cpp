// cache-train: illumination caches from photons.

#include "tools/cache-train/cache_train_tool.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "cache-train", "Learns from photons where light comes from",
    "--photons FILE|- [--in PREVIOUS.cache] -o scene.cache",
    R"(A tree splits space, and surfaces that face different ways; each of its cells learns a Gaussian
mixture over the directions that light comes from, by stepwise EM. The photons are read once more
at the end, when all cells are known: each mixture is fitted again to its photons, at most 512 of
them, and gets lobes for beams that few of them carry. From the standard input, and with --once,
they are read once. Memory grows with the cells and never with the photons. In media a tree splits
space alone; its cells learn the fluence and von Mises-Fisher lobes of direct and of indirect light
on the way, and the second time from which places indirect light comes.

Samples of camera paths (photon-trace --paths) teach a cell like photons, each kind by its evidence.

With --in, training goes on from a cache that was not reduced: photons of another pass refine it.

Examples:
  cache-train --photons room.photons -o room.cache
  cache-train --photons more.photons --in room.cache -o better.cache
  photon-trace room.xml -o - --count 100000000 | cache-train --photons - -o room.cache)"};

}  // namespace

int main(int argc, char** argv) {
  CacheTrainArguments arguments;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, arguments); },
      [&](ToolRun& run) { cache_train(run, kTool, arguments); });
}
