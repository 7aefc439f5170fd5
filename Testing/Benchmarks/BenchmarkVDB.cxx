/**
 * Processor time to write a skin into a .vdb file: for its triangles, the exact distances to the
 * triangles, the grid, and the file in several compressions. The time of the file includes its
 * validation, and is also printed as megabytes of active values per second.
 *
 *   BenchmarkVDB [voxel size, 0.01] [threads, 0: all]
 */
#include "Grids/SkinBand.h"
#include "Grids/SkinGrids.h"
#include "Grids/VDBOutput.h"
#include "NarrowBand.h"

#include <openvdb/io/Compression.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>

using namespace activesurface;

namespace
{

constexpr double Megabyte = 1e6;

// Processor time over all threads, so that other programs do not count.
template <class Work>
double Time(Work&& work)
{
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void Torus(std::size_t count, const double* points, double* values)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const double* x = points + 3 * i;
    values[i] = std::hypot(std::hypot(x[0], x[1]) - 0.6, x[2]) - 0.3;
  }
}

void PrintWriting(const openvdb::FloatGrid::Ptr& grid, std::uint32_t compression, const char* name)
{
  const std::string file = (std::filesystem::temp_directory_path() / "benchmark.vdb").string();
  const double size = 4.0 * static_cast<double>(grid->activeVoxelCount());
  const double seconds = Time([&] { WriteVDB(file, { grid }, {}, compression); });
  std::printf("file, %-12s %8.3f s  %7.0f MB/s of active values, %.1f MB\n", name, seconds,
    size / Megabyte / seconds, static_cast<double>(std::filesystem::file_size(file)) / Megabyte);
  std::filesystem::remove(file);
}

}

int main(int argc, char** argv)
{
  const double voxelSize = argc > 1 ? std::atof(argv[1]) : 0.01;
  NarrowBand band(voxelSize);
  band.SetNumberOfThreads(argc > 2 ? std::atoi(argv[2]) : 0);
  const double bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  band.Start(0.0, bounds, { Torus, true });

  LatticeMesh mesh;
  MeshBand distances;
  openvdb::FloatGrid::Ptr grid;
  const double triangles = Time([&] { mesh = MakeSkinMesh(band); });
  const double distance = Time([&] { distances = MakeSkinBand(band, mesh); });
  const double scaling = Time([&] { grid = MakeSurfaceGrid(distances, voxelSize); });
  const auto voxels = static_cast<double>(grid->activeVoxelCount());
  std::printf("%zu triangles, %.0f active voxels\n", mesh.Triangles.size(), voxels);
  std::printf("triangles          %8.3f s\n", triangles);
  std::printf("distances          %8.3f s  %7.0f ns a voxel\n", distance, 1e9 * distance / voxels);
  std::printf("grid               %8.3f s\n", scaling);
  using namespace openvdb::io;
  PrintWriting(grid, COMPRESS_NONE, "all values");
  PrintWriting(grid, COMPRESS_ACTIVE_MASK, "active ones");
  PrintWriting(grid, COMPRESS_ACTIVE_MASK | COMPRESS_BLOSC, "Blosc");
  return 0;
}
