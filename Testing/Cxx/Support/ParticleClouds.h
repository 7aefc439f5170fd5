/**
 * Particles of an input, read as a whole or by ranks, each of which has a piece of them.
 */
#ifndef ParticleClouds_h
#define ParticleClouds_h

#include "SharedResults.h"
#include "Targets/SharedFrame.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt64Array.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

struct CloudParticle
{
  SkeletonVertex Vertex;
  std::int64_t Id = 0;
  std::array<double, 3> Velocity = { 0.0, 0.0, 0.0 };
};

struct Cloud
{
  std::vector<CloudParticle> Particles;
  bool HasIds = true;
  bool HasVelocities = false;
  bool IsPassed = false; //< with an array of what number each has here, 100 of them and so on

  void Add(double x, double y, double z, double radius, double strength, std::int64_t id)
  {
    this->Particles.push_back({ { { x, y, z }, radius, strength }, id });
  }
};

/** Some of the particles, as an input. */
inline ParticleFrame ReadCloud(
  const Cloud& cloud, const std::vector<std::size_t>& chosen, Agreement* ranks)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> radii, strengths, velocities;
  vtkNew<vtkTypeInt64Array> ids;
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("number");
  velocities->SetNumberOfComponents(3);
  for (const std::size_t i : chosen)
  {
    const CloudParticle& particle = cloud.Particles[i];
    points->InsertNextPoint(particle.Vertex.Position);
    radii->InsertNextValue(particle.Vertex.Radius);
    strengths->InsertNextValue(particle.Vertex.Strength);
    velocities->InsertNextTuple(particle.Velocity.data());
    ids->InsertNextValue(particle.Id);
    numbers->InsertNextValue(100 * static_cast<int>(i));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->GetPointData()->AddArray(numbers);
  PointArrays arrays;
  if (!chosen.empty()) // as a rank without particles has no arrays
  {
    arrays.Radii = radii;
    arrays.Strengths = strengths;
    arrays.Ids = cloud.HasIds ? ids.Get() : nullptr;
    arrays.Velocities = cloud.HasVelocities ? velocities.Get() : nullptr;
  }
  arrays.Passed = cloud.IsPassed ? data->GetPointData() : nullptr;
  return ranks ? ReadSharedParticles(data, arrays, *ranks) : ReadParticles(data, arrays);
}

/** ranks: null, or those of which each brings a piece: with ids any of them, else a range; the last
 * one brings none, if there are more than two. */
inline ParticleFrame ReadCloud(const Cloud& cloud, Agreement* ranks)
{
  const auto size = static_cast<std::size_t>(ranks ? ranks->GetSize() : 1);
  const std::size_t pieces = size > 2 ? size - 1 : size;
  const std::size_t count = cloud.Particles.size();
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t owner = cloud.HasIds ? i * i % 7 % pieces : i * pieces / count;
    if (!ranks || owner == static_cast<std::size_t>(ranks->GetRank()))
    {
      chosen.push_back(i);
    }
  }
  return ReadCloud(cloud, chosen, ranks);
}

/** The same, at home. */
inline ParticleFrame ReadCloudHome(
  const Cloud& cloud, Agreement* ranks, ParticleModel model = ParticleModel::Sum)
{
  ParticleFrame frame = ReadCloud(cloud, ranks);
  if (ranks)
  {
    BringHome(GetNeighbourhoodPerRadius(model), frame);
  }
  return frame;
}

}

#endif
