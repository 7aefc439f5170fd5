#include "Surface/SkinParts.h"

#include "BandPart.h"
#include "Base/FixedSum.h"
#include "NarrowBand.h"
#include "Ranks/RankBytes.h"
#include "Surface/Skin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace activesurface
{

namespace
{

/** Sets of vertices that triangles connect. The number of a set is the number of its first vertex.
 */
class VertexSets
{
public:
  explicit VertexSets(std::size_t count)
    : Parent(count)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), std::int64_t(0));
  }

  std::int64_t Find(std::int64_t vertex)
  {
    while (this->Parent[vertex] != vertex)
    {
      this->Parent[vertex] = this->Parent[this->Parent[vertex]];
      vertex = this->Parent[vertex];
    }
    return vertex;
  }

  void Join(std::int64_t a, std::int64_t b)
  {
    a = this->Find(a);
    b = this->Find(b);
    this->Parent[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::int64_t> Parent;
};

/** Connected triangles, of this rank or of all ranks. */
struct ConnectedTriangles
{
  /** Number of the first vertex in the skin of all ranks. */
  std::int64_t FirstVertex = std::numeric_limits<std::int64_t>::max();
  std::int64_t Vertices = 0;
  std::int64_t Triangles = 0;
  FixedSum Area, Volume; //< [voxels^2, voxels^3]
  std::int64_t NumberOfBlocks = 0;

  void Add(const ConnectedTriangles& other)
  {
    this->FirstVertex = std::min(this->FirstVertex, other.FirstVertex);
    this->Vertices += other.Vertices;
    this->Triangles += other.Triangles;
    this->Area.Add(other.Area);
    this->Volume.Add(other.Volume);
  }
};

/** A vertex that several ranks have, and the number of its set on this rank. */
struct SharedVertex
{
  std::int64_t Number;
  std::int64_t Set;
};

/** Sets of connected triangles, each with the blocks of its vertices. */
struct SkinSets
{
  std::vector<ConnectedTriangles> Sets;
  std::vector<std::vector<PartBlock>> Blocks;
  std::vector<SharedVertex> Shared;

  Bytes Pack();
  /** Adds the packed sets of a rank. */
  void AddPacked(const Bytes& bytes);
  /** Unites sets that have a vertex in common. */
  void Unite();
};

void AddTriangle(const double* const corner[3], double voxelSize, ConnectedTriangles& set)
{
  double a[3], b[3], at[3];
  for (int d = 0; d < 3; ++d)
  {
    a[d] = (corner[1][d] - corner[0][d]) / voxelSize;
    b[d] = (corner[2][d] - corner[0][d]) / voxelSize;
    at[d] = corner[0][d] / voxelSize;
  }
  const double normal[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0] };
  set.Area.Add(
    .5 * std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]));
  set.Volume.Add((at[0] * normal[0] + at[1] * normal[1] + at[2] * normal[2]) / 6.0);
}

/** Adds the block of a vertex unless this block is the last in the list: successive vertices often
 * share a block. */
void AddBlock(const double x[3], double blockSize, std::vector<PartBlock>& blocks)
{
  PartBlock block;
  for (int d = 0; d < 3; ++d)
  {
    block[d] = static_cast<std::int32_t>(std::floor(x[d] / blockSize));
  }
  if (blocks.empty() || blocks.back() != block)
  {
    blocks.push_back(block);
  }
}

void MakeUnique(std::vector<PartBlock>& blocks)
{
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
}

Bytes SkinSets::Pack()
{
  std::vector<PartBlock> blocks;
  for (std::size_t s = 0; s < this->Sets.size(); ++s)
  {
    this->Sets[s].NumberOfBlocks = static_cast<std::int64_t>(this->Blocks[s].size());
    blocks.insert(blocks.end(), this->Blocks[s].begin(), this->Blocks[s].end());
  }
  Bytes bytes =
    ToBytes(std::vector<std::uint64_t>{ this->Sets.size(), this->Shared.size(), blocks.size() });
  AppendBytes(this->Sets, bytes);
  AppendBytes(this->Shared, bytes);
  AppendBytes(blocks, bytes);
  return bytes;
}

void SkinSets::AddPacked(const Bytes& bytes)
{
  BytesReader reader(bytes);
  const auto counts = reader.Read<std::uint64_t>(3);
  const auto before = static_cast<std::int64_t>(this->Sets.size());
  const auto sets = reader.Read<ConnectedTriangles>(counts[0]);
  for (SharedVertex shared : reader.Read<SharedVertex>(counts[1]))
  {
    shared.Set += before;
    this->Shared.push_back(shared);
  }
  const auto blocks = reader.Read<PartBlock>(counts[2]);
  auto next = blocks.begin();
  for (const ConnectedTriangles& set : sets)
  {
    this->Sets.push_back(set);
    this->Blocks.emplace_back(next, next + set.NumberOfBlocks);
    next += set.NumberOfBlocks;
  }
}

void SkinSets::Unite()
{
  std::sort(this->Shared.begin(), this->Shared.end(),
    [](const SharedVertex& a, const SharedVertex& b) { return a.Number < b.Number; });
  VertexSets united(this->Sets.size());
  for (std::size_t i = 1; i < this->Shared.size(); ++i)
  {
    if (this->Shared[i].Number == this->Shared[i - 1].Number)
    {
      united.Join(this->Shared[i].Set, this->Shared[i - 1].Set);
    }
  }
  SkinSets all;
  std::vector<std::size_t> places(this->Sets.size());
  for (std::size_t s = 0; s < this->Sets.size(); ++s)
  {
    const auto first = static_cast<std::size_t>(united.Find(static_cast<std::int64_t>(s)));
    if (first == s)
    {
      places[s] = all.Sets.size();
      all.Sets.push_back(this->Sets[s]);
      all.Blocks.push_back(std::move(this->Blocks[s]));
      continue;
    }
    std::vector<PartBlock>& blocks = all.Blocks[places[first]];
    all.Sets[places[first]].Add(this->Sets[s]);
    blocks.insert(blocks.end(), this->Blocks[s].begin(), this->Blocks[s].end());
  }
  *this = std::move(all);
}

/** The vertices and triangles of a rank. */
class RankSkin
{
public:
  explicit RankSkin(const NarrowBand& band)
    : Band(band)
    , Triangles(band)
    , Points(3 * Triangles.GetNumberOfPoints())
    , Corners(3 * Triangles.GetNumberOfTriangles())
    , Numbers(Triangles.NumberVertices())
    , SetOf(Numbers.size(), -1)
    , IsOwn(Numbers.size(), 1)
  {
    this->Triangles.Write(this->Points.data(), nullptr, this->Corners.data());
    const LeafTable& table = band.GetLeaves();
    for (std::size_t i = 0; i < table.Size(); ++i)
    {
      if (table.SummaryOf(i).IsForeign)
      {
        std::fill_n(this->IsOwn.begin() + static_cast<std::ptrdiff_t>(table[i].FirstCrossing),
          table[i].Crossings, char(0));
      }
    }
    for (const Skin::TriangleRange& range : this->Triangles.ListTriangles(0, 1))
    {
      this->Ranges.push_back({ 3 * range.First, 3 * range.Last });
    }
  }

  SkinSets FindSets()
  {
    this->Connect();
    SkinSets sets;
    this->AddVertices(sets);
    this->AddTriangles(sets);
    if (this->Band.GetPart())
    {
      this->ListShared(sets);
    }
    return sets;
  }

private:
  /** Calls visit(corner) for each triangle of this rank; corner: three vertex numbers. */
  template <class Visit>
  void ForEachTriangle(Visit&& visit) const
  {
    for (const Skin::TriangleRange& range : this->Ranges)
    {
      for (std::size_t c = range.First; c < range.Last; c += 3)
      {
        visit(this->Corners.data() + c);
      }
    }
  }

  void Connect()
  {
    VertexSets sets(this->Numbers.size());
    std::vector<char> isUsed = this->IsOwn;
    this->ForEachTriangle(
      [&](const std::int64_t* corner)
      {
        sets.Join(corner[0], corner[1]);
        sets.Join(corner[0], corner[2]);
        isUsed[corner[0]] = isUsed[corner[1]] = isUsed[corner[2]] = 1;
      });
    for (std::size_t v = 0; v < this->SetOf.size(); ++v)
    {
      if (isUsed[v])
      {
        const auto first = static_cast<std::size_t>(sets.Find(static_cast<std::int64_t>(v)));
        this->SetOf[v] = first == v ? this->Count++ : this->SetOf[first];
      }
    }
  }

  void AddVertices(SkinSets& sets) const
  {
    const double blockSize = VoxelsOfBlock * this->Band.GetVoxelSize();
    sets.Sets.resize(static_cast<std::size_t>(this->Count));
    sets.Blocks.resize(sets.Sets.size());
    for (std::size_t v = 0; v < this->SetOf.size(); ++v)
    {
      if (this->SetOf[v] < 0)
      {
        continue;
      }
      const auto s = static_cast<std::size_t>(this->SetOf[v]);
      sets.Sets[s].FirstVertex = std::min(sets.Sets[s].FirstVertex, this->Numbers[v]);
      if (this->IsOwn[v])
      {
        ++sets.Sets[s].Vertices;
        AddBlock(this->Points.data() + 3 * v, blockSize, sets.Blocks[s]);
      }
    }
    std::for_each(sets.Blocks.begin(), sets.Blocks.end(), MakeUnique);
  }

  void AddTriangles(SkinSets& sets) const
  {
    this->ForEachTriangle(
      [&](const std::int64_t* corner)
      {
        const double* const at[3] = { this->Points.data() + 3 * corner[0],
          this->Points.data() + 3 * corner[1], this->Points.data() + 3 * corner[2] };
        ConnectedTriangles& set = sets.Sets[static_cast<std::size_t>(this->SetOf[corner[0]])];
        ++set.Triangles;
        AddTriangle(at, this->Band.GetVoxelSize(), set);
      });
  }

  /** Lists vertices of other ranks in this rank's triangles, and own vertices in triangles of other
   * ranks. */
  void ListShared(SkinSets& sets) const
  {
    std::vector<char> isShared(this->SetOf.size(), 0);
    std::size_t next = 0;
    // Marks vertices with IsOwn == isOwn among the corners up to `end`.
    const auto mark = [&](std::size_t end, char isOwn)
    {
      for (; next < end; ++next)
      {
        const std::int64_t vertex = this->Corners[next];
        isShared[vertex] = isShared[vertex] || this->IsOwn[vertex] == isOwn ? 1 : 0;
      }
    };
    for (const Skin::TriangleRange& range : this->Ranges)
    {
      mark(range.First, 1);
      mark(range.Last, 0);
    }
    mark(this->Corners.size(), 1);
    for (std::size_t v = 0; v < isShared.size(); ++v)
    {
      if (isShared[v] && this->SetOf[v] >= 0)
      {
        sets.Shared.push_back({ this->Numbers[v], this->SetOf[v] });
      }
    }
  }

  const NarrowBand& Band;
  const Skin Triangles;
  std::vector<double> Points;
  std::vector<std::int64_t> Corners;
  std::vector<std::int64_t> Numbers; // in the skin of all ranks
  std::vector<std::int64_t> SetOf;   // of each vertex; -1: none on this rank
  std::vector<char> IsOwn;
  std::vector<Skin::TriangleRange> Ranges; // of corners
  std::int64_t Count = 0;
};

/** Collects the sets of all ranks on rank 0; other ranks get no sets. */
SkinSets Gather(SkinSets& own, const Agreement& ranks)
{
  SkinSets all;
  for (const Bytes& bytes : ranks.GatherToFirst(own.Pack()))
  {
    all.AddPacked(bytes);
  }
  all.Unite();
  std::for_each(all.Blocks.begin(), all.Blocks.end(), MakeUnique);
  return all;
}

}

std::vector<SkinPart> FindSkinParts(const NarrowBand& band)
{
  SkinSets sets = RankSkin(band).FindSets();
  if (band.GetPart())
  {
    sets = Gather(sets, band.GetPart()->GetRanks());
  }
  std::vector<std::size_t> order(sets.Sets.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&sets](std::size_t a, std::size_t b)
    { return sets.Sets[a].FirstVertex < sets.Sets[b].FirstVertex; });
  const double voxel = band.GetVoxelSize();
  std::vector<SkinPart> parts;
  parts.reserve(order.size());
  for (const std::size_t s : order)
  {
    const ConnectedTriangles& set = sets.Sets[s];
    SkinPart part;
    part.Area = set.Area.Get() * voxel * voxel;
    part.Volume = set.Volume.Get() * voxel * voxel * voxel;
    // V - E + F: a closed part of F triangles has E = 3 F / 2 edges.
    part.EulerCharacteristic = set.Vertices - set.Triangles / 2;
    part.Blocks = std::move(sets.Blocks[s]);
    parts.push_back(std::move(part));
  }
  return parts;
}

}
