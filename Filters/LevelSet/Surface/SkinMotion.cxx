#include "Surface/SkinMotion.h"

#include "Front/RowKernels.h"
#include "Front/SamplePoints.h"
#include "Front/SubstepBuffers.h"
#include "Front/TimeStep.h"
#include "Front/WalledTarget.h"
#include "NarrowBandGrid.h"
#include "Surface/NodeSpeeds.h"
#include "Surface/Skin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace activesurface
{

namespace
{

/** Writes 512 curvatures of a leaf [1/voxel]; valid are those at active nodes. */
void FindNodeCurvatures(const LeafTable& table, std::size_t i, float* curvatures)
{
  constexpr float sharpest = 4.f;
  LeafBlock block;
  block.Gather(table, table[i]);
  for (int row = 0; row < 64; ++row)
  {
    const float* u = block.Row(row / 8, row % 8);
    float squares[8], rates[8] = {}; // curvature * slope
    CentralGradientSquares(u, squares);
    AddTension(u, 1.f, rates);
    for (int z = 0; z < 8; ++z)
    {
      const float slope = std::sqrt(squares[z]);
      const float curvature = slope > 1e-6f ? rates[z] / slope : 0.f;
      curvatures[8 * row + z] = std::min(std::max(curvature, -sharpest), sharpest);
    }
  }
}

/** Interpolates from the nodes to the crossings of a leaf, and multiplies by a factor. */
void Interpolate(const LeafTable& table, std::size_t i, const std::vector<float>& atNodes,
  float factor, float* atVertices)
{
  const BandLeaf& leaf = table[i];
  float* vertex = atVertices + leaf.FirstCrossing;
  for (int axis = 0; axis < 3; ++axis)
  {
    leaf.Edge[axis].ForEach(
      [&](int node)
      {
        const LeafTable::Place upper = table.Step(static_cast<std::int32_t>(i), node, axis, 1);
        const float low = leaf.Value[node], high = table[upper.Leaf].Value[upper.Node];
        const float t = low / (low - high);
        *vertex++ = factor *
          ((1.f - t) * atNodes[512 * i + node] +
            t * atNodes[512 * std::size_t(upper.Leaf) + upper.Node]);
      });
  }
}

/** Returns the area of each vertex: a third of the area of its triangles. */
std::vector<double> FindVertexAreas(const Skin& skin)
{
  std::vector<double> points(3 * skin.GetNumberOfPoints()), areas(skin.GetNumberOfPoints());
  std::vector<std::int64_t> corners(3 * skin.GetNumberOfTriangles());
  skin.Write(points.data(), nullptr, corners.data());
  for (std::size_t c = 0; c < corners.size(); c += 3)
  {
    const double* a = points.data() + 3 * corners[c];
    const double* b = points.data() + 3 * corners[c + 1];
    const double* d = points.data() + 3 * corners[c + 2];
    const double p[3] = { b[0] - a[0], b[1] - a[1], b[2] - a[2] };
    const double q[3] = { d[0] - a[0], d[1] - a[1], d[2] - a[2] };
    const double area = .5 *
      std::hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]);
    for (std::size_t k = c; k < c + 3; ++k)
    {
      areas[corners[k]] += area / 3.0;
    }
  }
  return areas;
}

/** Returns the uniform speed that keeps the volume, or else the area. The change of the area is the
 * integral of speed * curvature. */
double FindHoldingSpeed(const Skin& skin, const Motion& motion,
  const std::vector<float>& curvatures, const std::vector<float>& speeds)
{
  const std::vector<double> areas = FindVertexAreas(skin);
  double change = 0.0, whole = 0.0;
  for (std::size_t v = 0; v < areas.size(); ++v)
  {
    const double weight =
      motion.VolumeControl == Control::Exact ? areas[v] : areas[v] * curvatures[v];
    change += weight * speeds[v];
    whole += weight;
  }
  return whole != 0.0 ? -change / whole : 0.0;
}

/** Adds the target's speed and the tension at each vertex. */
void AddTargetSpeed(const NarrowBand& band, const SkinForces& forces,
  const std::vector<float>& curvatures, std::vector<float>& speeds)
{
  const Motion& motion = forces.Strategy;
  SubstepBuffers buffers;
  if (motion.Attraction > 0.0)
  {
    forces.Attractor.MoveTo(band.GetTime());
    WalledTarget walled(forces.Attractor, motion.Box, motion.Solid);
    const LeafTable& table = band.GetLeaves();
    const LeafList all = table.FindAll([](std::size_t) { return true; });
    SampleLeaves({ table, GetPotential(band)->tree(), band.GetVoxelSize() }, all, motion,
      walled.IsCut() ? walled : forces.Attractor, buffers);
  }
  for (std::size_t v = 0; v < speeds.size(); ++v)
  {
    if (motion.Attraction > 0.0)
    {
      const double pull = -motion.Attraction * buffers.Samples[v];
      speeds[v] += std::isfinite(pull) ? static_cast<float>(pull) : 0.f;
    }
    speeds[v] -= static_cast<float>(motion.Tension * curvatures[v]);
  }
}

}

std::vector<float> FindCurvatures(const NarrowBand& band)
{
  const LeafTable& table = band.GetLeaves();
  const float factor = static_cast<float>(1.0 / band.GetVoxelSize());
  std::vector<float> atNodes(512 * table.Size());
  std::vector<float> atVertices(Skin(band).GetNumberOfPoints());
  band.Run(
    [&]
    {
      table.ForEach([&](std::size_t i) { FindNodeCurvatures(table, i, atNodes.data() + 512 * i); });
      table.ForEach(
        [&](std::size_t i) { Interpolate(table, i, atNodes, factor, atVertices.data()); });
    });
  return atVertices;
}

std::vector<float> FindSpeeds(const NarrowBand& band, const SkinForces& forces)
{
  const Motion& motion = forces.Strategy;
  const std::vector<float> curvatures = FindCurvatures(band);
  std::vector<float> speeds(curvatures.size());
  band.Run(
    [&]
    {
      motion.Integration == TimeIntegration::Nodes
        ? AddNodeSpeeds(band, forces, speeds)
        : AddTargetSpeed(band, forces, curvatures, speeds);
    });
  const PenaltyForce penalty = FindPenalty(
    motion, { band.GetArea(), band.GetVolume() }, { forces.StartArea, forces.StartVolume });
  for (std::size_t v = 0; v < speeds.size(); ++v)
  {
    speeds[v] += static_cast<float>(penalty.Speed);
  }
  if (motion.VolumeControl == Control::Exact || motion.AreaControl == Control::Exact)
  {
    const float holding =
      static_cast<float>(FindHoldingSpeed(Skin(band), motion, curvatures, speeds));
    for (float& speed : speeds)
    {
      speed += holding;
    }
  }
  return speeds;
}

}
