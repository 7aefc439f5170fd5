#include "State/PackedBand.h"

#include "Base/OpenVDB.h"
#include "State/StateGrid.h"

#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace activesurface
{

namespace
{

/** Packed data of a leaf, except its magnitudes. */
struct LeafBits
{
  std::int32_t Origin[4]; //< the last one is 0, so that no byte is unset
  LeafMask Inside;
  LeafMask Active;
};

struct Counts
{
  std::uint64_t Leaves = 0;
  std::uint64_t Nodes = 0;
};

/** Copies `count` values to or from bytes; returns the next byte. */
template <class Value>
char* Write(const Value* from, std::size_t count, char* to)
{
  std::copy_n(reinterpret_cast<const char*>(from), count * sizeof(Value), to);
  return to + count * sizeof(Value);
}
template <class Value>
const char* Read(const char* from, std::size_t count, Value* to)
{
  std::copy_n(from, count * sizeof(Value), reinterpret_cast<char*>(to));
  return from + count * sizeof(Value);
}

std::size_t SizeOf(const Counts& counts)
{
  return sizeof(Counts) + counts.Leaves * sizeof(LeafBits) + counts.Nodes * sizeof(float);
}

LeafMask KnownNodes(const BandLeaf& leaf, bool hasGhosts)
{
  return hasGhosts ? leaf.Active : leaf.UpToLayer[LastLayer];
}

/** Calls visit(leaf) for the packed leaves. */
template <class Visit>
void ForEachPacked(const LeafTable& table, bool hasForeign, Visit&& visit)
{
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    const LeafSummary& summary = table.SummaryOf(i);
    if (summary.IsUsed && (hasForeign || !summary.IsForeign))
    {
      visit(table[i]);
    }
  }
}

void AppendLeaves(const LeafTable& table, bool hasGhosts, bool hasForeign, std::string& bytes)
{
  Counts counts;
  ForEachPacked(table, hasForeign,
    [&](const BandLeaf& leaf)
    {
      ++counts.Leaves;
      counts.Nodes += static_cast<std::uint64_t>(KnownNodes(leaf, hasGhosts).Count());
    });
  const std::size_t before = bytes.size();
  bytes.resize(before + SizeOf(counts));
  char* bits = Write(&counts, 1, &bytes[before]);
  char* magnitudes = bits + counts.Leaves * sizeof(LeafBits);
  ForEachPacked(table, hasForeign,
    [&](const BandLeaf& leaf)
    {
      const LeafBits own = { { leaf.Origin[0], leaf.Origin[1], leaf.Origin[2], 0 }, leaf.Inside,
        KnownNodes(leaf, hasGhosts) };
      bits = Write(&own, 1, bits);
      own.Active.ForEach(
        [&](int node)
        {
          const float magnitude = std::fabs(leaf.Value[node]);
          magnitudes = Write(&magnitude, 1, magnitudes);
        });
    });
}

}

void PackBand(const LeafTable& table, bool hasGhosts, std::string& bytes)
{
  AppendLeaves(table, hasGhosts, false, bytes);
}

void PackPart(
  const LeafTable& table, bool hasGhosts, const openvdb::FloatTree& tree, std::string& bytes)
{
  std::vector<openvdb::Coord> inside;
  auto tile = tree.cbeginValueOff();
  tile.setMaxDepth(openvdb::FloatTree::ValueOffCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile)
  {
    if (*tile < 0.f)
    {
      inside.push_back(tile.getCoord());
    }
  }
  const std::uint64_t count = inside.size();
  const std::size_t before = bytes.size();
  bytes.resize(before + sizeof count + count * sizeof(openvdb::Coord));
  Write(inside.data(), inside.size(), Write(&count, 1, &bytes[before]));
  AppendLeaves(table, hasGhosts, true, bytes);
}

namespace
{

openvdb::Coord OriginOf(const LeafBits& bits)
{
  return { bits.Origin[0], bits.Origin[1], bits.Origin[2] };
}

void FillLeaf(const LeafBits& bits, float background, const float*& magnitude, PotentialLeaf& leaf)
{
  float* value = leaf.buffer().data();
  for (int node = 0; node < 512; ++node)
  {
    const float size = bits.Active.Has(node) ? *magnitude++ : background;
    value[node] = bits.Inside.Has(node) ? -size : size;
  }
  leaf.setValuesOn(); // so that flood fill does not change the leaf
}

void SetActive(const LeafBits& bits, PotentialLeaf& leaf)
{
  PotentialLeaf::NodeMaskType mask;
  for (int x = 0; x < 8; ++x)
  {
    mask.getWord<std::uint64_t>(x) = bits.Active.Word[x];
  }
  leaf.setValueMask(mask);
}

void CheckCounts(const std::string& bytes, const Counts& counts)
{
  if (counts.Leaves > bytes.size() || counts.Nodes > bytes.size() || SizeOf(counts) != bytes.size())
  {
    RefuseState();
  }
}

std::uint64_t CountActive(const std::vector<LeafBits>& leaves)
{
  std::uint64_t active = 0;
  for (const LeafBits& leaf : leaves)
  {
    active += static_cast<std::uint64_t>(leaf.Active.Count());
  }
  return active;
}

/** Adds packed leaves to a list and to a tree. */
void UnpackLeaves(const std::string& bytes, std::vector<LeafBits>& leaves, openvdb::FloatTree& tree)
{
  Counts counts;
  if (bytes.size() < sizeof counts)
  {
    RefuseState();
  }
  const char* from = Read(bytes.data(), 1, &counts);
  CheckCounts(bytes, counts);
  std::vector<LeafBits> here(counts.Leaves);
  std::vector<float> magnitudes(counts.Nodes);
  from = Read(from, here.size(), here.data());
  Read(from, magnitudes.size(), magnitudes.data());
  if (CountActive(here) != counts.Nodes)
  {
    RefuseState();
  }
  const float* magnitude = magnitudes.data();
  for (const LeafBits& bits : here)
  {
    FillLeaf(bits, tree.background(), magnitude, *tree.touchLeaf(OriginOf(bits)));
  }
  leaves.insert(leaves.end(), here.begin(), here.end());
}

void SetActive(const std::vector<LeafBits>& leaves, openvdb::FloatTree& tree)
{
  for (const LeafBits& bits : leaves)
  {
    SetActive(bits, *tree.probeLeaf(OriginOf(bits)));
  }
}

}

openvdb::FloatTree::Ptr UnpackBand(const std::vector<std::string>& parts, float background)
{
  auto tree = std::make_shared<openvdb::FloatTree>(background);
  std::vector<LeafBits> leaves;
  for (const std::string& bytes : parts)
  {
    UnpackLeaves(bytes, leaves, *tree);
  }
  openvdb::tools::signedFloodFillWithValues(*tree, background, -background);
  SetActive(leaves, *tree);
  CheckTree(*tree);
  return tree;
}

openvdb::FloatTree::Ptr UnpackPart(const std::string& bytes, float background)
{
  std::uint64_t count = 0;
  if (bytes.size() < sizeof count)
  {
    RefuseState();
  }
  const char* from = Read(bytes.data(), 1, &count);
  if (count > bytes.size() || sizeof count + count * sizeof(openvdb::Coord) > bytes.size())
  {
    RefuseState();
  }
  std::vector<openvdb::Coord> inside(count);
  Read(from, inside.size(), inside.data());
  auto tree = std::make_shared<openvdb::FloatTree>(background);
  std::vector<LeafBits> leaves;
  UnpackLeaves(bytes.substr(sizeof count + count * sizeof(openvdb::Coord)), leaves, *tree);
  SetActive(leaves, *tree);
  for (const openvdb::Coord& origin : inside)
  {
    tree->addTile(1, origin, -background, false);
  }
  return tree;
}

}
