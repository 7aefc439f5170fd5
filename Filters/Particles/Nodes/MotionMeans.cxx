#include "Nodes/MotionMeans.h"

#include "Base/FloatLanes.h"
#include "Base/InstructionSets.h"
#include "Index/UnsetVector.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

// A mean displacement in a body is reduced to 0 if its square is at most this multiple of its
// squared standard error, and by less if its square is larger.
constexpr float ErrorsOfMotion = 6.f;
// Fewer than two particles, counted by their weights, have no standard error.
constexpr float FewParticles = .5f; // 1 / number of particles
// A leaf is still if no displacement along an axis exceeds this [voxels].
constexpr float Still = 1e-4f;

struct Neighbour
{
  float Place[3];
  float Displacement[3];
  float Square; // squared length of the displacement
  float IsMoved;
  float Bulk;
  float InverseReach2;
};

using Neighbours = UnsetVector<Neighbour>;

// Keeps the particles whose supports touch the leaf.
struct KeepKernel
{
  const MotionColumns& Columns;
  const ParticleRuns& Runs;
  Neighbour*& End;

  ACTIVE_ALWAYS_INLINE void operator()() const
  {
    Neighbour* to = this->End;
    const Lanes half = AllLanes(4.f), zero = AllLanes(0.f), one = AllLanes(1.f);
    for (const ParticleRun& run : this->Runs)
    {
      for (std::uint32_t k = run.First; k < run.End; k += 8)
      {
        Lanes square = zero;
        for (int axis = 0; axis < 3; ++axis)
        {
          const Lanes place = LoadLanes(this->Columns.Place[axis] + k) + AllLanes(run.Shift[axis]);
          const Lanes beyond = Largest(Size(place - half) - half, zero);
          square += beyond * beyond;
        }
        unsigned near = BitsOf(square * LoadLanes(this->Columns.InverseReach2 + k) < one);
        near &= run.End - k >= 8 ? 0xffu : (1u << (run.End - k)) - 1u;
        for (; near != 0; near &= near - 1)
        {
          this->Keep(k + static_cast<std::uint32_t>(LowestBit(near)), run, *to++);
        }
      }
    }
    this->End = to;
  }

private:
  ACTIVE_ALWAYS_INLINE void Keep(std::uint32_t k, const ParticleRun& run, Neighbour& to) const
  {
    to.Square = 0.f;
    for (int axis = 0; axis < 3; ++axis)
    {
      to.Place[axis] = this->Columns.Place[axis][k] + run.Shift[axis];
      to.Displacement[axis] = this->Columns.Displacement[axis][k];
      to.Square += to.Displacement[axis] * to.Displacement[axis];
    }
    to.IsMoved = this->Columns.IsMoved[k];
    to.Bulk = this->Columns.Bulk ? this->Columns.Bulk[k] : 1.f;
    to.InverseReach2 = this->Columns.InverseReach2[k];
  }
};

// Sums at all points of a leaf, padded by five.
struct Sums
{
  static constexpr int Size = 32;
  alignas(32) float All[Size];     // of weights
  alignas(32) float Bulk[Size];    // of weights * bulk
  alignas(32) float Moved[Size];   // of the weights of particles with a known displacement
  alignas(32) float Squares[Size]; // of the squares of these weights
  alignas(32) float Displacement[3][Size];
  alignas(32) float Square[Size]; // of weights * displacement^2
};

struct SumKernel
{
  const Neighbours& Near;
  Sums& Result;

  ACTIVE_ALWAYS_INLINE void operator()() const
  {
    for (int first = 0; first < Sums::Size; first += 8)
    {
      alignas(32) float place[3][8];
      for (int i = 0; i < 8; ++i)
      {
        const int point = std::min(first + i, LeafMotion::Points - 1);
        const int at[3] = { point / 9, point / 3 % 3, point % 3 };
        for (int axis = 0; axis < 3; ++axis)
        {
          place[axis][i] = 4.f * static_cast<float>(at[axis]);
        }
      }
      this->SumAt(LoadLanes(place[0]), LoadLanes(place[1]), LoadLanes(place[2]), first);
    }
  }

private:
  ACTIVE_ALWAYS_INLINE void SumAt(
    const Lanes& x0, const Lanes& y0, const Lanes& z0, int first) const
  {
    const Lanes one = AllLanes(1.f), zero = AllLanes(0.f);
    Lanes all = zero, bulk = zero, moved = zero, squares = zero, square = zero;
    Lanes dx = zero, dy = zero, dz = zero;
    for (const Neighbour& n : this->Near)
    {
      const Lanes x = AllLanes(n.Place[0]) - x0, y = AllLanes(n.Place[1]) - y0,
                  z = AllLanes(n.Place[2]) - z0;
      const Lanes u = Largest(one - (x * x + y * y + z * z) * AllLanes(n.InverseReach2), zero);
      const Lanes weight = u * u, counted = weight * AllLanes(n.IsMoved);
      all += weight;
      bulk += weight * AllLanes(n.Bulk);
      moved += counted;
      squares += counted * counted;
      dx += counted * AllLanes(n.Displacement[0]);
      dy += counted * AllLanes(n.Displacement[1]);
      dz += counted * AllLanes(n.Displacement[2]);
      square += counted * AllLanes(n.Square);
    }
    StoreLanes(this->Result.All + first, all);
    StoreLanes(this->Result.Bulk + first, bulk);
    StoreLanes(this->Result.Moved + first, moved);
    StoreLanes(this->Result.Squares + first, squares);
    StoreLanes(this->Result.Displacement[0] + first, dx);
    StoreLanes(this->Result.Displacement[1] + first, dy);
    StoreLanes(this->Result.Displacement[2] + first, dz);
    StoreLanes(this->Result.Square + first, square);
  }
};

struct PointMotion
{
  float Displacement[3] = { 0.f, 0.f, 0.f };
  bool IsKnown = false;
  bool IsWeak = true; // from too few particles
};

// Points whose displacement is unknown, or is from few particles (near the ends of the kernels),
// get the mean of the other points. If all points have few particles, only unknown points get the
// mean (0 if all are unknown).
void FillUnknown(const PointMotion (&points)[LeafMotion::Points], LeafMotion& motion)
{
  const bool areAllWeak =
    std::all_of(points, points + LeafMotion::Points, [](const PointMotion& p) { return p.IsWeak; });
  float largest = 0.f;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto counts = [&](const PointMotion& p)
    { return p.IsKnown && (areAllWeak || !p.IsWeak); };
    float sum = 0.f;
    int known = 0;
    for (const PointMotion& point : points)
    {
      sum += counts(point) ? point.Displacement[axis] : 0.f;
      known += counts(point) ? 1 : 0;
    }
    const float mean = known > 0 ? sum / static_cast<float>(known) : 0.f;
    for (int i = 0; i < LeafMotion::Points; ++i)
    {
      const float own = counts(points[i]) ? points[i].Displacement[axis] : mean;
      motion.Displacement[axis][i] = own;
      largest = std::max(largest, std::fabs(own));
    }
  }
  motion.IsStill = !(largest > Still);
}

}

void FindMotionMeans(
  const MotionColumns& columns, const ParticleRuns& runs, bool hasNoise, LeafMotion& motion)
{
  thread_local Neighbours near;
  std::size_t most = 0;
  for (const ParticleRun& run : runs)
  {
    most += run.End - run.First;
  }
  near.resize(most);
  Neighbour* end = near.data();
  RunCompiled(KeepKernel{ columns, runs, end });
  near.resize(static_cast<std::size_t>(end - near.data()));
  Sums sums;
  RunCompiled(SumKernel{ near, sums });
  PointMotion points[LeafMotion::Points];
  for (int i = 0; i < LeafMotion::Points; ++i)
  {
    motion.Bulk[i] = sums.All[i] > 0.f ? sums.Bulk[i] / sums.All[i] : 0.f;
    const float weight = sums.Moved[i];
    if (!(weight > 0.f))
    {
      continue;
    }
    PointMotion& point = points[i];
    point.IsKnown = true;
    const float few = sums.Squares[i] / (weight * weight);
    point.IsWeak = few > FewParticles;
    float square = 0.f;
    for (int axis = 0; axis < 3; ++axis)
    {
      point.Displacement[axis] = sums.Displacement[axis][i] / weight;
      square += point.Displacement[axis] * point.Displacement[axis];
    }
    constexpr float least = 1e-3f;
    const float error =
      std::max(sums.Square[i] / weight - square, 0.f) * few / std::max(1.f - few, least);
    const float noise = point.IsWeak ? 1.f
      : square > 0.f                 ? std::min(ErrorsOfMotion * error / square, 1.f)
                                     : 0.f;
    const float share = hasNoise ? 1.f - std::min(2.f * motion.Bulk[i], 1.f) * noise : 1.f;
    for (float& displacement : point.Displacement)
    {
      displacement *= share;
    }
  }
  FillUnknown(points, motion);
}

}
