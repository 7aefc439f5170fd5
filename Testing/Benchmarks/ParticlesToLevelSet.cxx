// Conversion of particles to a mesh by OpenVDB, one frame for each line of the standard input;
// particles.py starts this program, and compares.
//
// Run: ParticlesToLevelSet <threads>
//
// Each input line holds the path of a file of positions (x y z, single precision), the radius of
// the spheres, and the voxel size. Each output line holds seconds and the number of quads. The
// spheres are joined (tools::ParticlesToLevelSet), smoothed by four steps of
// LevelSetFilter::meanCurvature, and meshed (tools::volumeToMesh, no normals), all with OpenVDB's
// defaults. The time to read the file does not count.

#include "Measuring.h"

#include <openvdb/tools/LevelSetFilter.h>
#include <openvdb/tools/ParticlesToLevelSet.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

using namespace activesurface;

namespace
{
constexpr int SmoothingSteps = 4;

struct Particles
{
  using PosType = openvdb::Vec3R;
  std::vector<openvdb::Vec3s> Positions;

  std::size_t size() const { return this->Positions.size(); }
  void getPos(std::size_t i, openvdb::Vec3R& position) const { position = this->Positions[i]; }
};

Particles ReadParticles(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(file), {} };
  if (!file || bytes.size() % sizeof(openvdb::Vec3s) != 0)
  {
    throw std::runtime_error("No positions in " + path + ".");
  }
  const auto* first = reinterpret_cast<const openvdb::Vec3s*>(bytes.data());
  Particles particles;
  particles.Positions.assign(first, first + bytes.size() / sizeof(openvdb::Vec3s));
  return particles;
}

std::size_t MakeMesh(const Particles& particles, double radius, double voxelSize)
{
  auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(static_cast<float>(voxelSize));
  openvdb::tools::ParticlesToLevelSet<openvdb::FloatGrid> spheres(*grid);
  spheres.rasterizeSpheres(particles, radius);
  spheres.finalize(true);
  openvdb::tools::LevelSetFilter<openvdb::FloatGrid> filter(*grid);
  for (int i = 0; i < SmoothingSteps; ++i)
  {
    filter.meanCurvature();
  }
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid, points, quads);
  return quads.size();
}
}

int main(int argc, char** argv)
{
  openvdb::initialize();
  const int threads = argc > 1 ? std::atoi(argv[1]) : 1;
  WithThreads(threads,
    []
    {
      std::string path;
      double radius;
      double voxelSize;
      while (std::cin >> path >> radius >> voxelSize)
      {
        const Particles particles = ReadParticles(path);
        std::size_t quads = 0;
        const double seconds = SecondsOf([&] { quads = MakeMesh(particles, radius, voxelSize); });
        std::printf("%.6f %zu\n", seconds, quads);
        std::fflush(stdout);
      }
    });
}
