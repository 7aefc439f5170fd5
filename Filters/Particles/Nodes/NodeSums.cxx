#include "Nodes/NodeSums.h"

#include "Base/FloatLanes.h"
#include "Base/InstructionSets.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

struct ScatterKernel
{
  const EllipsoidColumns& Columns;
  const NodeEllipsoid* Ellipsoids;
  const ParticleRuns& Runs;
  std::uint64_t Rows;
  float* Sums;

  ACTIVE_ALWAYS_INLINE void operator()() const
  {
    for (int n = 0; n < 512; n += 8)
    {
      StoreLanes(this->Sums + n, AllLanes(0.f));
    }
    for (const ParticleRun& run : this->Runs)
    {
      this->AddRun(run);
    }
    for (int n = 0; n < 512; n += 8)
    {
      StoreLanes(this->Sums + n, AllLanes(1.f) - Root(Root(LoadLanes(this->Sums + n))));
    }
  }

private:
  ACTIVE_ALWAYS_INLINE void AddRun(const ParticleRun& run) const
  {
    const Lanes middle = AllLanes(3.5f), zero = AllLanes(0.f);
    for (std::uint32_t k = run.First; k < run.End; k += 8)
    {
      const Lanes x = LoadLanes(this->Columns.X + k) + AllLanes(run.Shift[0]);
      const Lanes y = LoadLanes(this->Columns.Y + k) + AllLanes(run.Shift[1]);
      const Lanes z = LoadLanes(this->Columns.Z + k) + AllLanes(run.Shift[2]);
      const Lanes gx = Largest(Size(x - middle) - middle, zero);
      const Lanes gy = Largest(Size(y - middle) - middle, zero);
      const Lanes gz = Largest(Size(z - middle) - middle, zero);
      unsigned near = BitsOf(gx * gx + gy * gy + gz * gz < LoadLanes(this->Columns.Reach2 + k));
      near &= run.End - k >= 8 ? 0xffu : (1u << (run.End - k)) - 1u;
      for (; near != 0; near &= near - 1)
      {
        const int i = LowestBit(near);
        const float centre[3] = { x[i], y[i], z[i] };
        this->AddOne(this->Ellipsoids[k + static_cast<std::uint32_t>(i)], centre);
      }
    }
  }

  // Adds an ellipsoid. In a row of nodes, d^2 = a + z (2 b + m z), with z the offset from the
  // centre and m the entry zz of Metric. Finds a and b for the eight rows of a plane x at once, and
  // omits rows where the minimum of d^2 is at least 1.
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

}

void FindPotential(const EllipsoidColumns& columns, const NodeEllipsoid* ellipsoids,
  const ParticleRuns& runs, std::uint64_t rows, float* values)
{
  RunCompiled(ScatterKernel{ columns, ellipsoids, runs, rows, values });
}

}
