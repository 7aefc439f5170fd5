#include "Surface/NodeSpeeds.h"

#include "Base/SkinForces.h"
#include "NarrowBand.h"
#include "Nodes/NodeCarry.h"
#include "Nodes/NodeStages.h"
#include "Surface/Skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace activesurface
{

namespace
{

/** Motion at the vertices. */
struct VertexMotion
{
  std::vector<double> Points;  //< x y z of each
  std::vector<float> Normals;  //< of each
  std::vector<double> Ways;    //< displacement of each in the whole frame [length]
  std::vector<float> Bulks;    //< of each
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

void FindWays(const NarrowBand& band, NodeTarget& nodes, VertexMotion& vertices)
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
          vertices.Ways[3 * v + axis] = voxel * Interpolate(motion.Displacement[axis], place);
        }
        vertices.Bulks[v] = Interpolate(motion.Bulk, place);
      }
    });
}

/** Adds sign * distance to the target at each vertex, moved by share * displacement. A distance
 * that is not finite makes the change not finite. */
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
      places[k] = vertices.Points[3 * first + k] + share * vertices.Ways[3 * first + k];
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
  vertices.Ways.resize(3 * count);
  vertices.Bulks.resize(count);
  vertices.Changes.resize(count);
  std::vector<std::int64_t> corners(3 * skin.GetNumberOfTriangles());
  skin.Write(vertices.Points.data(), vertices.Normals.data(), corners.data());
  Target& target = forces.Attractor;
  constexpr double wholeWay = 1.0;
  target.GetNodes()->PlaceNodes({ forces.Begin, forces.End, wholeWay, band.GetVoxelSize() });
  FindWays(band, *target.GetNodes(), vertices);
  target.MoveTo(forces.Begin);
  AddDistances(band, target, -share, -1.0, vertices);
  target.MoveTo(forces.End);
  AddDistances(band, target, 1.0 - share, 1.0, vertices);
  return vertices;
}

}

void AddNodeSpeeds(const NarrowBand& band, const SkinForces& forces, std::vector<float>& speeds)
{
  const double duration = forces.End - forces.Begin;
  if (!(duration > 0.0))
  {
    return;
  }
  const double share = std::min(std::max((band.GetTime() - forces.Begin) / duration, 0.0), 1.0);
  const VertexMotion vertices = FindMotion(band, forces, share);
  StageCoefficients law;
  law.Decay = static_cast<float>(forces.Strategy.Attraction * duration);
  law.Noise = forces.Attractor.GetNodes()->GetNoise();
  const double voxel = band.GetVoxelSize();
  for (std::size_t v = 0; v < speeds.size(); ++v)
  {
    double along = 0.0;
    for (std::size_t k = 3 * v; k < 3 * v + 3; ++k)
    {
      along += vertices.Ways[k] * vertices.Normals[k];
    }
    const double change = vertices.Changes[v];
    const double followed =
      FindFollowedShare(law, static_cast<float>(change / voxel), vertices.Bulks[v]);
    const double speed = (along - (std::isfinite(change) ? followed * change : 0.0)) / duration;
    speeds[v] += static_cast<float>(speed);
  }
}

}
