#include "SkeletonCells.h"

#include "ParallelTasks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace activesurface
{
namespace
{
// Radii in a lattice are 0.31 to 0.63 cells. Smaller cells hold fewer candidates, but cost more
// time and memory.
constexpr double CellsPerRadius = 0.63;
// A segment has pieces of up to two cells; one with too many pieces uses coarser cells.
constexpr double CellsPerPiece = 2.0;
constexpr double MaximumPieces = 32.0;
constexpr double HalfCellDiagonal = 0.8660255;
constexpr std::size_t MaximumElements = std::size_t(1) << 28;
// Balls are stored as floats, relative to a point less than 4 cells away: errors are below 1e-6.
constexpr double FloatMargin = 1e-5;
// A range of slots stays in the caches while it is filled.
constexpr int LeastBitsOfRange = 14;
constexpr std::size_t MostRanges = 64;
constexpr std::size_t LeastElementsOfChunk = 4096;
constexpr std::size_t MostChunks = 256;
constexpr float Everywhere = std::numeric_limits<float>::infinity();

double GetLength(const Capsule& capsule)
{
  return std::hypot(capsule.End[0] - capsule.Start[0], capsule.End[1] - capsule.Start[1],
    capsule.End[2] - capsule.Start[2]);
}
}

void SkeletonCells::Build(const std::vector<Capsule>& capsules, const double bounds[6])
{
  this->Lattices.clear();
  if (capsules.empty())
  {
    return;
  }
  if (capsules.size() > MaximumElements)
  {
    throw std::length_error("A skeleton of more than 268 million elements is not supported.");
  }
  this->Measure(capsules, bounds);
  this->ChooseLattices(capsules);
  this->MakeSlots();
  this->RegisterAll(capsules);
  this->FillLists();
}

void SkeletonCells::Measure(const std::vector<Capsule>& capsules, const double bounds[6])
{
  double largestCoordinate = 0.0;
  for (int i = 0; i < 6; ++i)
  {
    largestCoordinate = std::max(largestCoordinate, std::fabs(bounds[i]));
  }
  this->Slack = 32.0 * std::numeric_limits<double>::epsilon() * largestCoordinate;
  this->LargestRadius = 0.0;
  for (const Capsule& capsule : capsules)
  {
    this->LargestRadius = std::max({ this->LargestRadius, capsule.StartRadius, capsule.EndRadius });
  }
  this->LargestRadius += this->Slack;
  this->FirstCellSize = this->LargestRadius / CellsPerRadius;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Origin[axis] = bounds[2 * axis];
  }
}

void SkeletonCells::ChooseLattices(const std::vector<Capsule>& capsules)
{
  int coarsest = std::numeric_limits<int>::max();
  this->LatticeOf.resize(capsules.size());
  for (std::size_t element = 0; element < capsules.size(); ++element)
  {
    this->LatticeOf[element] = this->ChooseLevel(capsules[element]);
    coarsest = std::min(coarsest, this->LatticeOf[element]);
  }
  std::array<std::size_t, MaximumLattices> elements = {};
  for (int& level : this->LatticeOf)
  {
    level = std::min(level - coarsest, static_cast<int>(MaximumLattices) - 1);
    ++elements[level];
  }
  std::array<int, MaximumLattices> latticeOfLevel;
  for (std::size_t level = 0; level < MaximumLattices; ++level)
  {
    latticeOfLevel[level] = static_cast<int>(this->Lattices.size());
    if (elements[level] > 0)
    {
      const int halvings = static_cast<int>(level) + coarsest;
      const double cellSize = std::ldexp(this->FirstCellSize, -halvings);
      this->Lattices.push_back({ { this->Origin[0], this->Origin[1], this->Origin[2] }, cellSize,
        1.0 / cellSize, elements[level], 0, 0 });
    }
  }
  for (int& level : this->LatticeOf)
  {
    level = latticeOfLevel[level];
  }
}

// Level l has cells of size FirstCellSize / 2^l. The level is negative for segments that are long
// compared with the largest radius.
int SkeletonCells::ChooseLevel(const Capsule& capsule) const
{
  const double radius = std::max(capsule.StartRadius, capsule.EndRadius) + this->Slack;
  const int level = std::ilogb(this->LargestRadius / radius);
  const double length = GetLength(capsule);
  const double longest = MaximumPieces * CellsPerPiece * this->FirstCellSize;
  return length > 0.0 ? std::min(level, std::ilogb(longest / length)) : level;
}

void SkeletonCells::MakeSlots()
{
  std::size_t slots = 0;
  for (SkeletonLattice& lattice : this->Lattices)
  {
    int bits = SkeletonLattice::BlockBits + 1;
    while ((std::size_t(1) << bits) < 4 * lattice.Elements)
    {
      ++bits;
    }
    lattice.HashShift = 64 - (bits - SkeletonLattice::BlockBits);
    lattice.FirstSlot = slots;
    slots += std::size_t(1) << bits;
  }
  this->ListStarts.resize(slots + 1);
  this->BitsOfRange = LeastBitsOfRange;
  while (slots >> this->BitsOfRange > MostRanges)
  {
    ++this->BitsOfRange;
  }
}

void SkeletonCells::RegisterAll(const std::vector<Capsule>& capsules)
{
  const std::size_t elements = capsules.size();
  const std::size_t perChunk = std::max(LeastElementsOfChunk, elements / MostChunks + 1);
  const std::size_t ranges = ((this->ListStarts.size() - 2) >> this->BitsOfRange) + 1;
  this->Chunks.resize((elements + perChunk - 1) / perChunk);
  RunTasks(this->Chunks.size(),
    [&](std::size_t n)
    {
      Chunk& chunk = this->Chunks[n];
      chunk.resize(ranges);
      for (std::vector<Registration>& registrations : chunk)
      {
        registrations.clear();
      }
      for (std::size_t i = n * perChunk; i < std::min((n + 1) * perChunk, elements); ++i)
      {
        this->Register(static_cast<Index>(i), capsules[i], chunk);
      }
    });
}

void SkeletonCells::Register(Index element, const Capsule& capsule, Chunk& chunk) const
{
  const SkeletonLattice& lattice = this->Lattices[this->LatticeOf[element]];
  const double length = GetLength(capsule);
  if (length == 0.0)
  {
    const double radius = std::max(capsule.StartRadius, capsule.EndRadius);
    this->RegisterBall(element, capsule.Start, radius + this->Slack, lattice, chunk);
    return;
  }
  const double pieceLength = CellsPerPiece * lattice.CellSize;
  const int pieces = std::max(1, static_cast<int>(std::ceil(length / pieceLength)));
  for (int i = 0; i < pieces; ++i)
  {
    const double from = static_cast<double>(i) / pieces;
    const double to = static_cast<double>(i + 1) / pieces;
    this->RegisterPiece(element, this->GetPiece(capsule, from, to), lattice, chunk);
  }
}

struct SkeletonCells::Span
{
  static constexpr int Capacity = 8; // a ball's diameter is 1.3 cells at most
  int Count = 0;
  double Gap2[Capacity]; // squared distance from the cell's slab to the centre, in cells
  float Place[Capacity]; // of the centre, relative to the cell's centre
  std::uint64_t Hash[Capacity];
  Index InBlock[Capacity];
  bool IsLast[Capacity];
};

// The first and the last cell contain all points beyond.
SkeletonCells::Span SkeletonCells::GetSpan(
  const SkeletonLattice& lattice, int axis, double centre, double radius)
{
  Span span;
  const double place = lattice.GetCoordinate(centre, axis);
  const Index low = SkeletonLattice::GetCell(lattice.GetCoordinate(centre - radius, axis));
  const Index high = SkeletonLattice::GetCell(lattice.GetCoordinate(centre + radius, axis));
  for (Index cell = low; cell <= high && span.Count < Span::Capacity; ++cell)
  {
    const double offset = place - cell;
    const double below = cell == 0 ? 0.0 : -offset;
    const double above = cell == SkeletonLattice::LastCell ? 0.0 : offset - 1.0;
    const double gap = std::max({ below, above, 0.0 });
    span.Gap2[span.Count] = gap * gap;
    span.Place[span.Count] = static_cast<float>(offset - 0.5);
    span.Hash[span.Count] = SkeletonLattice::GetHash(cell, axis);
    span.InBlock[span.Count] = SkeletonLattice::GetPlaceInBlock(cell, axis);
    span.IsLast[span.Count] = cell == SkeletonLattice::LastCell;
    ++span.Count;
  }
  return span;
}

void SkeletonCells::RegisterBall(Index element, const double centre[3], double radius,
  const SkeletonLattice& lattice, Chunk& chunk) const
{
  const Span xs = this->GetSpan(lattice, 0, centre[0], radius);
  const Span ys = this->GetSpan(lattice, 1, centre[1], radius);
  const Span zs = this->GetSpan(lattice, 2, centre[2], radius);
  const double cells = radius * lattice.InverseCellSize;
  const double radius2 = cells * cells * (1.0 + FloatMargin) + FloatMargin;
  for (int k = 0; k < zs.Count; ++k)
  {
    for (int j = 0; j < ys.Count; ++j)
    {
      const double gap2 = zs.Gap2[k] + ys.Gap2[j];
      for (int i = 0; i < xs.Count; ++i)
      {
        if (gap2 + xs.Gap2[i] <= radius2)
        {
          const bool isFar = xs.IsLast[i] || ys.IsLast[j] || zs.IsLast[k];
          const float ball[4] = { xs.Place[i], ys.Place[j], zs.Place[k],
            isFar ? Everywhere : static_cast<float>(radius2) };
          const std::size_t slot = lattice.GetSlot(
            xs.Hash[i] + ys.Hash[j] + zs.Hash[k], xs.InBlock[i] | ys.InBlock[j] | zs.InBlock[k]);
          this->AddTo(chunk, slot, element, ball);
        }
      }
    }
  }
}

// Adds each element once to each slot.
void SkeletonCells::AddTo(Chunk& chunk, std::size_t slot, Index element, const float ball[4]) const
{
  std::vector<Registration>& registrations = chunk[slot >> this->BitsOfRange];
  for (auto own = registrations.rbegin(); own != registrations.rend() && own->Element == element;
       ++own)
  {
    if (own->Slot == slot)
    {
      return;
    }
  }
  registrations.push_back(
    { static_cast<Index>(slot), element, { ball[0], ball[1], ball[2], ball[3] } });
}

SkeletonCells::Piece SkeletonCells::GetPiece(const Capsule& capsule, double from, double to) const
{
  Piece piece;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double edge = capsule.End[axis] - capsule.Start[axis];
    piece.Start[axis] = capsule.Start[axis] + from * edge;
    piece.Edge[axis] = (to - from) * edge;
  }
  const double change = capsule.EndRadius - capsule.StartRadius;
  piece.Radius = capsule.StartRadius + std::max(from * change, to * change) + this->Slack;
  return piece;
}

void SkeletonCells::RegisterPiece(
  Index element, const Piece& piece, const SkeletonLattice& lattice, Chunk& chunk) const
{
  Index low[3];
  Index high[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double lowEnd = piece.Start[axis] + std::min(piece.Edge[axis], 0.0) - piece.Radius;
    const double highEnd = piece.Start[axis] + std::max(piece.Edge[axis], 0.0) + piece.Radius;
    low[axis] = SkeletonLattice::GetCell(lattice.GetCoordinate(lowEnd, axis));
    high[axis] = SkeletonLattice::GetCell(lattice.GetCoordinate(highEnd, axis));
  }
  const float ball[4] = { 0.0f, 0.0f, 0.0f, Everywhere };
  Index cell[3];
  for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2])
  {
    for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1])
    {
      for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0])
      {
        if (this->Touches(piece, lattice, cell))
        {
          this->AddTo(chunk, lattice.GetSlot(cell), element, ball);
        }
      }
    }
  }
}

// Returns true if the piece comes near the ball around the cell.
bool SkeletonCells::Touches(const Piece& piece, const SkeletonLattice& lattice, const Index cell[3])
{
  double centre[3];
  double along = 0.0;
  double length2 = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (cell[axis] == 0 || cell[axis] == SkeletonLattice::LastCell)
    {
      return true;
    }
    centre[axis] = lattice.Origin[axis] + (cell[axis] + 0.5) * lattice.CellSize - piece.Start[axis];
    along += centre[axis] * piece.Edge[axis];
    length2 += piece.Edge[axis] * piece.Edge[axis];
  }
  const double t = length2 > 0.0 ? std::min(std::max(along / length2, 0.0), 1.0) : 0.0;
  double distance2 = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double offset = centre[axis] - t * piece.Edge[axis];
    distance2 += offset * offset;
  }
  const double reach = piece.Radius + HalfCellDiagonal * lattice.CellSize;
  return distance2 <= reach * reach;
}

// Counting sort by slot, range by range.
void SkeletonCells::FillLists()
{
  this->RangeStarts.assign(1, 0);
  for (std::size_t range = 0; range < this->Chunks.front().size(); ++range)
  {
    std::size_t end = this->RangeStarts.back();
    for (const Chunk& chunk : this->Chunks)
    {
      end += chunk[range].size();
    }
    this->RangeStarts.push_back(end);
  }
  const std::size_t size = this->RangeStarts.back();
  if (size > std::numeric_limits<Index>::max())
  {
    throw std::length_error("The skeleton has too many elements; use fewer elements.");
  }
  this->Lists.resize(size);
  this->Balls.resize(4 * size);
  this->ListStarts.back() = static_cast<Index>(size);
  this->Filled.resize(this->ListStarts.size() - 1);
  RunTasks(this->RangeStarts.size() - 1, [this](std::size_t range) { this->FillRange(range); });
}

// Elements are added in ascending order, so lists are ascending.
void SkeletonCells::FillRange(std::size_t range)
{
  const std::size_t first = range << this->BitsOfRange;
  const std::size_t end =
    std::min(first + (std::size_t(1) << this->BitsOfRange), this->Filled.size());
  std::fill(this->Filled.begin() + first, this->Filled.begin() + end, 0);
  for (const Chunk& chunk : this->Chunks)
  {
    for (const Registration& registration : chunk[range])
    {
      ++this->Filled[registration.Slot];
    }
  }
  std::size_t start = this->RangeStarts[range];
  for (std::size_t slot = first; slot < end; ++slot)
  {
    this->ListStarts[slot] = static_cast<Index>(start);
    start += std::exchange(this->Filled[slot], 0);
  }
  for (const Chunk& chunk : this->Chunks)
  {
    for (const Registration& registration : chunk[range])
    {
      const std::size_t slot = registration.Slot;
      const std::size_t list = this->ListStarts[slot];
      const std::size_t length = (slot + 1 < end ? this->ListStarts[slot + 1] : start) - list;
      const std::size_t place = this->Filled[slot]++;
      this->Lists[list + place] = registration.Element;
      for (std::size_t column = 0; column < 4; ++column)
      {
        this->Balls[4 * list + column * length + place] = registration.Ball[column];
      }
    }
  }
}

}
