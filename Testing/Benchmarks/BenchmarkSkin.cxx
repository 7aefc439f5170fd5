// From the potential to a mesh with normals, compared with vtkFlyingEdges3D on a dense image of the
// same potential and OpenVDB's volumeToMesh on the same grid.
//
// Run: BenchmarkSkin [quick]
//
// A ball of radius 0.9 in [-1,1]^3, n nodes along a side. Our code and vtkFlyingEdges3D write the
// same mesh, vertex by vertex: points and normals in single precision, 64-bit corners. Filling the
// dense image does not count, and every array is allocated in each repetition. volumeToMesh
// produces quads without normals; "with normals" adds normals from the gradient of the grid at the
// points (six trilinear samples each).

#include "Measuring.h"
#include "NarrowBandGrid.h"
#include "Scenes.h"
#include "Surface/Skin.h"
#include "Surface/SkinDistance.h"

#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <tbb/parallel_for.h>

#include <cstdint>
#include <memory>

using namespace activesurface;

namespace
{
double MakeSkin(const NarrowBand& band, std::size_t& triangles)
{
  return SecondsOf(
    [&]
    {
      const Skin skin(band);
      triangles = skin.GetNumberOfTriangles();
      const std::size_t count = skin.GetNumberOfPoints();
      // A std::vector would set its elements to zero first.
      const std::unique_ptr<float[]> points(new float[3 * count]);
      const std::unique_ptr<float[]> normals(new float[3 * count]);
      const std::unique_ptr<std::int64_t[]> corners(new std::int64_t[3 * triangles]);
      skin.Write(points.get(), normals.get(), corners.get());
    });
}

vtkSmartPointer<vtkImageData> MakeImage(const NarrowBand& band, int n)
{
  const int half = n / 2;
  const int extent[6] = { -half, half - 1, -half, half - 1, -half, half - 1 };
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(const_cast<int*>(extent));
  image->SetSpacing(band.GetVoxelSize(), band.GetVoxelSize(), band.GetVoxelSize());
  image->AllocateScalars(VTK_FLOAT, 1);
  WriteDistances(band, extent, static_cast<float*>(image->GetScalarPointer()));
  return image;
}

double RunFlyingEdges(vtkImageData* image, std::size_t& triangles)
{
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOn();
  contour->ComputeScalarsOff();
  contour->ComputeGradientsOff();
  const double seconds = SecondsOf([&] { contour->Update(); });
  triangles = static_cast<std::size_t>(contour->GetOutput()->GetNumberOfPolys());
  return seconds;
}

std::vector<openvdb::Vec3s> FindNormals(
  const openvdb::FloatGrid& grid, const std::vector<openvdb::Vec3s>& points)
{
  std::vector<openvdb::Vec3s> normals(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 1024),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      const openvdb::FloatGrid::ConstAccessor values = grid.getConstAccessor();
      const auto at = [&](const openvdb::Vec3d& point)
      { return openvdb::tools::BoxSampler::sample(values, point); };
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          openvdb::Vec3d step(0.0);
          step[axis] = 0.5;
          normals[i][axis] = at(points[i] + step) - at(points[i] - step);
        }
        normals[i].normalize();
      }
    });
  return normals;
}

double RunVolumeToMesh(const openvdb::FloatGrid& grid, bool withNormals)
{
  return SecondsOf(
    [&]
    {
      std::vector<openvdb::Vec3s> points;
      std::vector<openvdb::Vec4I> quads;
      openvdb::tools::volumeToMesh(grid, points, quads);
      if (withNormals)
      {
        FindNormals(grid, points);
      }
    });
}

void Compare(int n, int threads, int repetitions)
{
  NarrowBand band(VoxelSizeOf(n));
  band.SetNumberOfThreads(threads);
  band.Start(0.0, Box, MakeInitial(BallDistance{ 0.9 }));
  const auto image = MakeImage(band, n);
  const openvdb::FloatGrid::Ptr grid = GetPotential(band)->deepCopy();
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  std::size_t ours = 0;
  std::size_t theirs = 0;
  const std::vector<Contestant> contestants = {
    { "skin", [&] { return 1e3 * MakeSkin(band, ours); } },
    { "vtkFlyingEdges3D", [&] { return 1e3 * RunFlyingEdges(image, theirs); } },
    { "volumeToMesh", [&] { return 1e3 * RunVolumeToMesh(*grid, false); } },
    { "volumeToMesh with normals", [&] { return 1e3 * RunVolumeToMesh(*grid, true); } },
  };
  std::vector<Costs> costs;
  WithThreads(threads, [&] { costs = MeasureInTurns(contestants, repetitions); });
  const Work work = { "skin", "n = " + std::to_string(n), threads };
  TellContest(work, "ms", contestants, costs);
  Tell(work, "triangles", "", { static_cast<double>(ours) });
  Tell(work, "triangles of vtkFlyingEdges3D", "", { static_cast<double>(theirs) });
}
}

int main(int argc, char** argv)
{
  openvdb::initialize();
  const bool isQuick = IsQuick(argc, argv);
  for (const int n : { 128, 256 })
  {
    for (const int threads : ThreadsToMeasure())
    {
      Compare(n, threads, isQuick ? 5 : 15);
    }
  }
}
