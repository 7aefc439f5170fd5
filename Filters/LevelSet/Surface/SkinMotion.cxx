#include "Surface/SkinMotion.h"

#include "Base/SkinForces.h"
#include "Base/Tension.h"
#include "Front/RowKernels.h"
#include "Front/SamplePoints.h"
#include "Front/SubstepBuffers.h"
#include "Front/TimeStep.h"
#include "Front/WalledTarget.h"
#include "NarrowBand.h"
#include "NarrowBandGrid.h"
#include "Nodes/NodeCarry.h"
#include "Nodes/NodeStages.h"
#include "Surface/Skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace activesurface
{

namespace
{

struct VertexMotion
{
  std::vector<double> Points;        //< x y z of each vertex
  std::vector<float> Normals;        //< of each vertex
  std::vector<double> Displacements; //< displacement of each vertex in the whole frame [length]
  std::vector<float> Bulks;          //< of each vertex
  std::vector<double> Changes; //< change of the distance to the target along the path [length]
};

/** Interpolates linearly between the points of a leaf's motion. place: in nodes from the leaf's
 * first node. */
float Interpolate(const float (&values)[LeafMotion::Points], const double (&place)[3])
{
  int low[3];
  double t[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double at = std::min(std::max(0.25 * place[axis], 0.0), 2.0);
    low[axis] = std::min(static_cast<int>(at), 1);
    t[axis] = at - low[axis];
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int step[3] = { corner >> 2, corner >> 1 & 1, corner & 1 };
    double weight = 1.0;
    int point = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      weight *= step[axis] ? t[axis] : 1.0 - t[axis];
      point = 3 * point + low[axis] + step[axis];
    }
    sum += weight * values[point];
  }
  return static_cast<float>(sum);
}

void FindDisplacements(const NarrowBand& band, NodeTarget& nodes, VertexMotion& vertices)
{
  const double voxel = band.GetVoxelSize();
  const LeafTable& table = band.GetLeaves();
  table.ForEach(
    [&](std::size_t i)
    {
      const BandLeaf& leaf = table[i];
      if (leaf.Crossings == 0)
      {
        return;
      }
      const NodeIndex origin = { leaf.Origin[0], leaf.Origin[1], leaf.Origin[2] };
      LeafMotion motion;
      nodes.FindMotion({ origin, 0, 0 }, motion);
      for (std::size_t v = leaf.FirstCrossing; v < leaf.FirstCrossing + leaf.Crossings; ++v)
      {
        double place[3];
        for (int axis = 0; axis < 3; ++axis)
        {
          place[axis] = vertices.Points[3 * v + axis] / voxel - origin[axis];
        }
        for (int axis = 0; axis < 3; ++axis)
        {
          vertices.Displacements[3 * v + axis] =
            voxel * Interpolate(motion.Displacement[axis], place);
        }
        vertices.Bulks[v] = Interpolate(motion.Bulk, place);
      }
    });
}

/** Adds sign * d to the change of each vertex. d: distance from the target to the vertex moved by
 * share * displacement. If d is not finite, the change is not finite. */
void AddDistances(
  const NarrowBand& band, const Target& target, double share, double sign, VertexMotion& vertices)
{
  const LeafTable& table = band.GetLeaves();
  const auto add = [&](std::size_t i)
  {
    const BandLeaf& leaf = table[i];
    const std::size_t first = leaf.FirstCrossing, count = static_cast<std::size_t>(leaf.Crossings);
    std::vector<double> places(3 * count), values(count), slopes(count);
    for (std::size_t k = 0; k < 3 * count; ++k)
    {
      places[k] = vertices.Points[3 * first + k] + share * vertices.Displacements[3 * first + k];
    }
    TargetResults results;
    results.Values = values.data();
    results.Slopes = slopes.data();
    target.Evaluate(count, places.data(), results);
    for (std::size_t k = 0; k < count; ++k)
    {
      vertices.Changes[first + k] += sign * values[k];
    }
  };
  if (target.IsThreadSafe())
  {
    table.ForEach(add);
    return;
  }
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    add(i);
  }
}

VertexMotion FindMotion(const NarrowBand& band, const SkinForces& forces, double share)
{
  const Skin skin(band);
  const std::size_t count = skin.GetNumberOfPoints();
  VertexMotion vertices;
  vertices.Points.resize(3 * count);
  vertices.Normals.resize(3 * count);
  vertices.Displacements.resize(3 * count);
  vertices.Bulks.resize(count);
  vertices.Changes.resize(count);
  std::vector<std::int64_t> corners(3 * skin.GetNumberOfTriangles());
  skin.Write(vertices.Points.data(), vertices.Normals.data(), corners.data());
  Target& target = forces.Target;
  constexpr double wholeDisplacement = 1.0;
  target.GetNodes()->PlaceNodes(
    { forces.Begin, forces.End, wholeDisplacement, band.GetVoxelSize() });
  FindDisplacements(band, *target.GetNodes(), vertices);
  target.MoveTo(forces.Begin);
  AddDistances(band, target, -share, -1.0, vertices);
  target.MoveTo(forces.End);
  AddDistances(band, target, 1.0 - share, 1.0, vertices);
  return vertices;
}

/**
 * Adds the normal speeds of the skin in the node scheme.
 *
 * psi_b and psi_e are the distances to the target at the beginning and the end of a frame, D is the
 * mean displacement of the particles at a vertex, and f the elapsed fraction of the frame. The
 * speed is
 *   (D . n - r (psi_e(x + (1 - f) D) - psi_b(x - f D))) / (end - begin):
 * D . n is the motion with the particles, the other term is growth or shrinkage. r is the fraction
 * of a change of psi that the skin follows in a frame; r is small within the target's noise. If
 * begin = end, no speeds are added.
 */
void AddNodeSpeeds(const NarrowBand& band, const SkinForces& forces, std::vector<float>& speeds)
{
  const double duration = forces.End - forces.Begin;
  if (!(duration > 0.0))
  {
    return;
  }
  const double share = std::min(std::max((band.GetTime() - forces.Begin) / duration, 0.0), 1.0);
  const VertexMotion vertices = FindMotion(band, forces, share);
  StageCoefficients coefficients;
  coefficients.Decay = static_cast<float>(forces.Parameters.Attraction * duration);
  coefficients.Noise = forces.Target.GetNodes()->GetNoise();
  const double voxel = band.GetVoxelSize();
  for (std::size_t v = 0; v < speeds.size(); ++v)
  {
    double along = 0.0;
    for (std::size_t k = 3 * v; k < 3 * v + 3; ++k)
    {
      along += vertices.Displacements[k] * vertices.Normals[k];
    }
    const double change = vertices.Changes[v];
    const double followed =
      FindFollowedShare(coefficients, static_cast<float>(change / voxel), vertices.Bulks[v]);
    const double speed = (along - (std::isfinite(change) ? followed * change : 0.0)) / duration;
    speeds[v] += static_cast<float>(speed);
  }
}

/** Writes 512 curvatures of a leaf [1/voxel]; only values at active nodes are valid. */
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
    AddTension<LeafBlock::X, LeafBlock::Y>(u, 1.f, rates);
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

/** Returns the uniform speed that conserves the volume if VolumeControl is exact, otherwise the
 * area. The change of the area is the integral of speed * curvature. */
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
  Motion motion = forces.Parameters;
  motion.Evaluation = TargetEvaluation::Shifted; // one sample for each vertex
  motion.Paper = false;
  SubstepBuffers buffers;
  if (motion.Attraction > 0.0)
  {
    forces.Target.MoveTo(band.GetTime());
    WalledTarget walled(forces.Target, motion.Box, motion.Solid);
    const LeafTable& table = band.GetLeaves();
    const LeafList all = table.FindAll([](std::size_t) { return true; });
    SampleLeaves({ table, GetPotential(band)->tree(), band.GetVoxelSize() }, all, motion,
      walled.IsCut() ? walled : forces.Target, buffers);
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
  const Motion& motion = forces.Parameters;
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
