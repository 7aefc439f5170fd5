#include "Front/Displacement.h"

#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace activesurface
{

namespace
{

float ValueAt(const LeafTable& table, const LeafTable::Place& place)
{
  return place.Leaf >= 0 ? table[place.Leaf].Value[place.Node] : table.BackgroundOf(place.Leaf);
}

double Difference(const LeafTable& table, const LeafTable::Place& place, int axis)
{
  const double ahead = ValueAt(table, table.Step(place.Leaf, place.Node, axis, 1));
  const double behind = ValueAt(table, table.Step(place.Leaf, place.Node, axis, -1));
  return .5 * (ahead - behind);
}

/** Component of the normal along an axis, at the fraction t of the edge between two nodes. */
double NormalAlong(const LeafTable& table, const LeafTable::Place& lower,
  const LeafTable::Place& upper, int axis, double t)
{
  double square = 0.0, along = 0.0;
  for (int d = 0; d < 3; ++d)
  {
    const double component =
      (1.0 - t) * Difference(table, lower, d) + t * Difference(table, upper, d);
    square += component * component;
    along = d == axis ? component : along;
  }
  return square > 0.0 ? along / std::sqrt(square) : 1.0;
}

}

void Displacement::Begin(const LeafTable& table)
{
  this->Leaves.resize(table.Size());
  this->Values.resize(512 * table.Size());
  table.ForEach(
    [&](std::size_t i)
    {
      const BandLeaf& leaf = table[i];
      this->Leaves[i] = { leaf.Origin, leaf.Edge, leaf.Inside,
        { leaf.Neighbour[FaceNumber(0, 1)], leaf.Neighbour[FaceNumber(1, 1)],
          leaf.Neighbour[FaceNumber(2, 1)] } };
      std::copy_n(leaf.Value, 512, this->Values.data() + 512 * i);
    });
}

/**
 * Calls function with the displacement along the normal [voxels] of each sample point of leaf i
 * whose edge is still crossed, with the same end inside.
 */
template <class Function>
void Displacement::ForEachPoint(const LeafTable& table, std::size_t i, Function&& function) const
{
  const Leaf& before = this->Leaves[i];
  const std::int32_t now = table.Find(before.Origin);
  for (int axis = 0; now >= 0 && axis < 3; ++axis)
  {
    const int stride = Stride(axis);
    (before.Edge[axis] & table[now].Edge[axis])
      .ForEach(
        [&](int node)
        {
          if (before.Inside.Has(node) != table[now].Inside.Has(node))
          {
            return;
          }
          const bool within = (node / stride) % 8 < 7;
          const std::size_t upperBefore = within
            ? 512 * i + node + stride
            : 512 * std::size_t(before.Next[axis]) + node - 7 * stride;
          const double low = this->Values[512 * i + node], high = this->Values[upperBefore];
          const LeafTable::Place lower{ now, node };
          const LeafTable::Place upper = table.Step(now, node, axis, 1);
          const double lowNow = ValueAt(table, lower), highNow = ValueAt(table, upper);
          const double t = lowNow / (lowNow - highNow);
          const double moved = t - low / (low - high);
          function(std::fabs(moved * NormalAlong(table, lower, upper, axis, t)));
        });
  }
}

double Displacement::GetLargest(const LeafTable& table) const
{
  return tbb::parallel_reduce(
    tbb::blocked_range<std::size_t>(0, this->Leaves.size(), 16), 0.0,
    [&](const tbb::blocked_range<std::size_t>& leaves, double largest)
    {
      for (std::size_t i = leaves.begin(); i != leaves.end(); ++i)
      {
        this->ForEachPoint(
          table, i, [&largest](double distance) { largest = std::max(largest, distance); });
      }
      return largest;
    },
    [](double a, double b) { return std::max(a, b); });
}

Displacement::Statistics Displacement::GetStatistics(const LeafTable& table, double distance) const
{
  std::size_t all = 0, found = 0, near = 0;
  double sum = 0.0;
  for (std::size_t i = 0; i < this->Leaves.size(); ++i)
  {
    for (const LeafMask& edges : this->Leaves[i].Edge)
    {
      all += edges.Count();
    }
    this->ForEachPoint(table, i,
      [&](double moved)
      {
        sum += moved;
        ++found;
        near += moved <= distance ? 1 : 0;
      });
  }
  if (all == 0)
  {
    return { 0.0, 0.0 };
  }
  const auto count = static_cast<double>(all);
  return { static_cast<double>(all - near) / count,
    (sum + static_cast<double>(all - found)) / count };
}

namespace
{

constexpr std::size_t FirstWindow = 16; // substeps
constexpr double LeastDecay = 8.0;
constexpr double MostMean = .25;                    // voxels
constexpr double LeastRatio = .5, MostRatio = 1.25; // mean / average of the two means before

}

void SteadyWindow::Begin(const LeafTable& table, double time)
{
  this->Since.Begin(table);
  this->BeganAt = time;
  this->End = this->Substeps + std::max(this->Substeps, FirstWindow);
}

void SteadyWindow::Observe(const LeafTable& table, double time, double attraction)
{
  this->Steady = false;
  ++this->Substeps;
  if (this->End == 0)
  {
    this->Begin(table, time);
    return;
  }
  if (this->Substeps < this->End)
  {
    return;
  }
  const double before = this->Share;
  const auto [share, mean] = this->Since.GetStatistics(table, SteadyStateCriterion::Still);
  this->Share = share;
  const bool isLong = attraction * (time - this->BeganAt) >= LeastDecay;
  // Comparisons with NaN are false: fewMove in the first window, swings in the first two windows.
  const bool fewMove = this->Share <= SteadyStateCriterion::FewMoving && this->Share >= .5 * before;
  const double usual = .5 * (this->Mean + this->MeanBefore);
  const bool swings = mean <= MostMean && mean >= LeastRatio * usual && mean <= MostRatio * usual;
  this->Steady = isLong && (fewMove || swings);
  this->MeanBefore = std::exchange(this->Mean, mean);
  this->Begin(table, time);
}

}
