#include "Nodes/NodeSums.h"

#include "FloatLanes.h"
#include "InstructionSets.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

// Square of a mean displacement over that of its standard error, from which on it is motion.
constexpr float ErrorsOfMotion = 6.f;
// Fewer particles than two, counted by their weights, have no spread.
constexpr float FewParticles = .5f; // 1 over their number
// Displacements below this are none [voxels].
constexpr float Still = 1e-4f;

struct ScatterKernel
{
  const EllipsoidColumns& Columns;
  const NodeEllipsoid* Ellipsoids;
  std::uint32_t First, End;
  const float* Shift;
  std::uint64_t Rows;
  float* Sums;

  ACTIVE_ALWAYS_INLINE void operator()() const
  {
    const Lanes middle = AllLanes(3.5f), zero = AllLanes(0.f);
    for (std::uint32_t k = this->First; k < this->End; k += 8)
    {
      const Lanes x = LoadLanes(this->Columns.X + k) + AllLanes(this->Shift[0]);
      const Lanes y = LoadLanes(this->Columns.Y + k) + AllLanes(this->Shift[1]);
      const Lanes z = LoadLanes(this->Columns.Z + k) + AllLanes(this->Shift[2]);
      const Lanes gx = Largest(Size(x - middle) - middle, zero);
      const Lanes gy = Largest(Size(y - middle) - middle, zero);
      const Lanes gz = Largest(Size(z - middle) - middle, zero);
      unsigned near = BitsOf(gx * gx + gy * gy + gz * gz < LoadLanes(this->Columns.Reach2 + k));
      near &= this->End - k >= 8 ? 0xffu : (1u << (this->End - k)) - 1u;
      for (; near != 0; near &= near - 1)
      {
        const int i = LowestBit(near);
        const float centre[3] = { x[i], y[i], z[i] };
        this->AddOne(this->Ellipsoids[k + static_cast<std::uint32_t>(i)], centre);
      }
    }
  }

private:
  // From a plane x to the rows: for all eight of them the coefficients of q = a + z (2 b + m z) at
  // once, and whether the least of it is below 1.
  ACTIVE_ALWAYS_INLINE void AddOne(const NodeEllipsoid& e, const float (&c)[3]) const
  {
    const float* m = e.Metric;
    const int x0 = std::max(0, static_cast<int>(std::ceil(c[0] - e.Extent[0])));
    const int x1 = std::min(7, static_cast<int>(std::floor(c[0] + e.Extent[0])));
    const Lanes numbers = { 0.f, 1.f, 2.f, 3.f, 4.f, 5.f, 6.f, 7.f };
    const Lanes one = AllLanes(1.f), zero = AllLanes(0.f);
    const Lanes dy = numbers - AllLanes(c[1]), z = numbers - AllLanes(c[2]);
    const Lanes zz = AllLanes(m[5]), inverse = AllLanes(1.f / m[5]),
                strength = AllLanes(e.Strength);
    for (int x = x0; x <= x1; ++x)
    {
      const float dx = static_cast<float>(x) - c[0];
      const Lanes b = AllLanes(m[2] * dx) + AllLanes(m[4]) * dy;
      const Lanes a =
        AllLanes(m[0] * dx * dx) + dy * (AllLanes(2.f * m[1] * dx) + AllLanes(m[3]) * dy);
      unsigned hit =
        BitsOf(a - b * b * inverse < one) & static_cast<unsigned>(this->Rows >> (8 * x)) & 0xffu;
      alignas(32) float rest[8], twice[8];
      StoreLanes(rest, one - a);
      StoreLanes(twice, b + b);
      for (; hit != 0; hit &= hit - 1)
      {
        const int y = LowestBit(hit);
        const Lanes v = Largest(AllLanes(rest[y]) - z * (AllLanes(twice[y]) + zz * z), zero);
        float* to = this->Sums + 64 * x + 8 * y;
        StoreLanes(to, LoadLanes(to) + strength * v * (v * v));
      }
    }
  }
};

struct RootKernel
{
  float* Sums;

  ACTIVE_ALWAYS_INLINE void operator()() const
  {
    for (int n = 0; n < 512; n += 8)
    {
      StoreLanes(this->Sums + n, AllLanes(1.f) - Root(Root(LoadLanes(this->Sums + n))));
    }
  }
};

}

EllipsoidSum::EllipsoidSum(std::uint64_t rows, float* values)
  : Rows(rows)
  , Values(values)
{
  std::fill_n(values, 512, 0.f);
}

void EllipsoidSum::Add(const EllipsoidColumns& columns, const NodeEllipsoid* ellipsoids,
  std::uint32_t first, std::uint32_t end, const float (&shift)[3])
{
  RunCompiled(ScatterKernel{ columns, ellipsoids, first, end, shift, this->Rows, this->Values });
}

void EllipsoidSum::Finish()
{
  RunCompiled(RootKernel{ this->Values });
}

void MotionSum::Clear()
{
  this->Near.clear();
}

// Keeps those that reach the leaf.
void MotionSum::Add(
  const MotionColumns& columns, std::uint32_t first, std::uint32_t end, const float (&shift)[3])
{
  constexpr float half = 4.f;
  for (std::uint32_t k = first; k < end; ++k)
  {
    Neighbour n;
    float square = 0.f;
    n.Square = 0.f;
    for (int axis = 0; axis < 3; ++axis)
    {
      n.Place[axis] = columns.Place[axis][k] + shift[axis];
      n.Displacement[axis] = columns.Displacement[axis][k];
      const float beyond = std::max(std::fabs(n.Place[axis] - half) - half, 0.f);
      square += beyond * beyond;
      n.Square += n.Displacement[axis] * n.Displacement[axis];
    }
    n.IsMoved = columns.IsMoved[k];
    n.Bulk = columns.Bulk[k];
    n.InverseReach2 = columns.InverseReach2[k];
    if (square * n.InverseReach2 < 1.f)
    {
      this->Near.push_back(n);
    }
  }
}

// At all points of a leaf, and five more.
struct MotionSum::Sums
{
  static constexpr int Size = 32;
  alignas(32) float All[Size];     // of weights
  alignas(32) float Bulk[Size];    // of weights * bulk
  alignas(32) float Moved[Size];   // of the weights of particles with a known displacement
  alignas(32) float Squares[Size]; // of these weights' squares
  alignas(32) float Displacement[3][Size];
  alignas(32) float Square[Size]; // of weights * displacement^2
};

struct MotionSum::SumKernel
{
  const std::vector<Neighbour>& Near;
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

namespace
{

struct PointMotion
{
  float Displacement[3] = { 0.f, 0.f, 0.f };
  bool IsKnown = false;
  bool IsWeak = true; // by too few particles
};

// Points with few particles, at the end of their kernels, get the mean of the other points.
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

void MotionSum::Finish(bool hasNoise, LeafMotion& motion) const
{
  Sums sums;
  RunCompiled(SumKernel{ this->Near, sums });
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
