#include "BallCells.h"

#include "ParallelTasks.h"

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

namespace activesurface
{
namespace
{
constexpr std::size_t MaximumBalls = std::size_t(1) << 28;
// Group size in cells. Smaller groups have fewer balls near them; larger groups contain more
// points.
constexpr double GroupPerCell = 1.0;
// Finer levels are merged.
constexpr std::size_t MaximumLevels = 64;
constexpr std::size_t BallsPerChunk = 16384;
}

void BallCells::Build(const UnsetVector<Ball>& balls, double cellSize)
{
  this->CellSize = cellSize;
  this->Levels.clear();
  this->Order.clear();
  if (balls.empty())
  {
    return;
  }
  if (balls.size() > MaximumBalls)
  {
    throw std::length_error("More than 268 million particles are not supported.");
  }
  this->Measure(balls);
  this->FindSlots(balls);
  this->SortBySlots();
  this->FillBalls(balls);
}

// Bounding box of balls, and the largest radius of each cell size, by doublings.
struct BallCells::Sizes
{
  double Low[3];
  double High[3];
  std::map<int, double, std::greater<int>> Largest;

  Sizes()
  {
    std::fill_n(this->Low, 3, std::numeric_limits<double>::infinity());
    std::fill_n(this->High, 3, -std::numeric_limits<double>::infinity());
  }

  void Add(const Sizes& other)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = std::min(this->Low[axis], other.Low[axis]);
      this->High[axis] = std::max(this->High[axis], other.High[axis]);
    }
    for (const auto& [doublings, most] : other.Largest)
    {
      double& known = this->Largest[doublings];
      known = std::max(known, most);
    }
  }
};

void BallCells::Measure(const UnsetVector<Ball>& balls)
{
  std::vector<Sizes> ofPieces((balls.size() + BallsPerChunk - 1) / BallsPerChunk);
  RunPieces(balls.size(), BallsPerChunk,
    [&](std::size_t begin, std::size_t end)
    { ofPieces[begin / BallsPerChunk] = this->MeasurePiece(balls, begin, end); });
  Sizes all;
  for (const Sizes& piece : ofPieces)
  {
    all.Add(piece);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Bounds[2 * axis] = all.Low[axis];
    this->Bounds[2 * axis + 1] = all.High[axis];
  }
  for (const auto& [doublings, most] : all.Largest)
  {
    if (this->Levels.size() < MaximumLevels)
    {
      const double inverse = 1.0 / std::ldexp(this->CellSize, doublings);
      this->Levels.push_back({ doublings, inverse, most });
    }
  }
  this->GroupSize = GroupPerCell / this->Levels.back().InverseSize;
}

BallCells::Sizes BallCells::MeasurePiece(
  const UnsetVector<Ball>& balls, std::size_t begin, std::size_t end) const
{
  Sizes sizes;
  int doublings = 0;
  double* largest = nullptr;
  for (std::size_t i = begin; i < end; ++i)
  {
    const Ball& ball = balls[i];
    for (int axis = 0; axis < 3; ++axis)
    {
      sizes.Low[axis] = std::min(sizes.Low[axis], ball.Centre[axis] - ball.Radius);
      sizes.High[axis] = std::max(sizes.High[axis], ball.Centre[axis] + ball.Radius);
    }
    const int own = this->FindDoublings(ball.Radius);
    if (!largest || own != doublings)
    {
      doublings = own;
      largest = &sizes.Largest[own];
    }
    *largest = std::max(*largest, ball.Radius);
  }
  return sizes;
}

// Number of doublings of the requested cell size that gives the smallest cells not below the
// radius.
int BallCells::FindDoublings(double radius) const
{
  if (radius <= this->CellSize && 2.0 * radius > this->CellSize)
  {
    return 0; // usual case
  }
  const int doublings = std::ilogb(radius / this->CellSize);
  return std::ldexp(this->CellSize, doublings) < radius ? doublings + 1 : doublings;
}

std::size_t BallCells::FindLevel(double radius) const
{
  const int doublings = this->FindDoublings(radius);
  std::size_t level = 0;
  while (level + 1 < this->Levels.size() && this->Levels[level].Doublings > doublings)
  {
    ++level;
  }
  return level;
}

// Assigns each ball a slot: a cell of a block. Each chunk numbers its blocks in order of
// occurrence; then all blocks are numbered in the order of the chunks.
void BallCells::FindSlots(const UnsetVector<Ball>& balls)
{
  const std::size_t chunks = (balls.size() + BallsPerChunk - 1) / BallsPerChunk;
  this->Chunks.resize(chunks);
  this->Slots.resize(balls.size());
  RunPieces(balls.size(), BallsPerChunk,
    [&](std::size_t begin, std::size_t end) { this->FindSlotsOf(balls, begin, end); });
  this->Blocks.Clear();
  std::vector<std::vector<Index>> numbers(chunks);
  for (std::size_t chunk = 0; chunk < chunks; ++chunk)
  {
    for (std::size_t block = 0; block < this->Chunks[chunk].Size(); ++block)
    {
      numbers[chunk].push_back(this->Blocks.Add(this->Chunks[chunk][block]));
    }
  }
  RunEach(balls.size(),
    [&](std::size_t i)
    {
      const std::size_t slot = this->Slots[i], block = slot / CellsPerBlock;
      this->Slots[i] = numbers[i / BallsPerChunk][block] * CellsPerBlock + slot % CellsPerBlock;
    });
}

void BallCells::FindSlotsOf(const UnsetVector<Ball>& balls, std::size_t begin, std::size_t end)
{
  BlockTable& blocks = this->Chunks[begin / BallsPerChunk];
  blocks.Clear();
  for (std::size_t i = begin; i < end; ++i)
  {
    const std::size_t level = this->FindLevel(balls[i].Radius);
    BlockTable::Block block{ {}, static_cast<int>(level) };
    std::size_t inBlock = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Coordinate cell = GetCell(balls[i].Centre[axis] * this->Levels[level].InverseSize);
      block.At[axis] = cell >> 2;
      inBlock = 4 * inBlock + static_cast<std::size_t>(cell & 3);
    }
    this->Slots[i] = blocks.Add(block) * CellsPerBlock + inBlock;
  }
}

// Counting sort by slot; within a cell by index.
void BallCells::SortBySlots()
{
  this->Starts.assign(CellsPerBlock * this->Blocks.Size() + 2, 0);
  for (const std::size_t slot : this->Slots)
  {
    ++this->Starts[slot + 2];
  }
  std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
  this->Order.resize(this->Slots.size());
  for (std::size_t i = 0; i < this->Slots.size(); ++i)
  {
    this->Order[this->Starts[this->Slots[i] + 1]++] = static_cast<Index>(i);
  }
}

void BallCells::FillBalls(const UnsetVector<Ball>& balls)
{
  for (UnsetVector<float>& column : this->Columns)
  {
    column.resize(balls.size());
  }
  RunEach(balls.size(),
    [&](std::size_t k)
    {
      const std::size_t block = this->Slots[this->Order[k]] / CellsPerBlock;
      this->FillBall(k, balls[this->Order[k]], this->Blocks[block]);
    });
}

void BallCells::FillBall(std::size_t k, const Ball& ball, const BlockTable::Block& block)
{
  const double inverse = this->Levels[block.Level].InverseSize;
  bool isLast = false;
  double farthest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double place = ball.Centre[axis] * inverse;
    this->Columns[axis][k] = Clamp(place - static_cast<double>(4 * block.At[axis]));
    isLast = isLast || IsLast(GetCell(place));
    farthest = std::max(farthest, std::fabs(place));
  }
  this->Columns[3][k] = isLast ? Everywhere : GetSquare(ball.Radius * inverse + Slack * farthest);
}

}
