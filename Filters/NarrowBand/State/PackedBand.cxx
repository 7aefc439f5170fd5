#include "State/PackedBand.h"

#include "OpenVDB.h"
#include "State/SavedTree.h"

#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace activesurface
{

namespace
{

/** What is known of a leaf without its values. */
struct LeafBits
{
  std::int32_t Origin[4]; //< the last one 0: no byte is left unset
  LeafMask Inside;
  LeafMask Active;
};

struct Counts
{
  std::uint64_t Leaves = 0;
  std::uint64_t Nodes = 0;
};

/** Copies some of them to or from bytes; returns the next byte. */
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

}

std::string PackBand(const LeafTable& table, bool hasGhosts)
{
  std::vector<LeafBits> leaves;
  std::vector<float> magnitudes;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    const BandLeaf& leaf = table[i];
    if (table.SummaryOf(i).IsUsed)
    {
      const LeafMask known = hasGhosts ? leaf.Active : leaf.UpToLayer[LastLayer];
      leaves.push_back(
        { { leaf.Origin[0], leaf.Origin[1], leaf.Origin[2], 0 }, leaf.Inside, known });
      known.ForEach([&](int node) { magnitudes.push_back(std::fabs(leaf.Value[node])); });
    }
  }
  const Counts counts{ leaves.size(), magnitudes.size() };
  std::string bytes(SizeOf(counts), '\0');
  char* to = Write(&counts, 1, &bytes[0]);
  to = Write(leaves.data(), leaves.size(), to);
  Write(magnitudes.data(), magnitudes.size(), to);
  return bytes;
}

namespace
{

void FillLeaf(const LeafBits& bits, float background, const float*& magnitude, PotentialLeaf& leaf)
{
  float* value = leaf.buffer().data();
  for (int node = 0; node < 512; ++node)
  {
    const float size = bits.Active.Has(node) ? *magnitude++ : background;
    value[node] = bits.Inside.Has(node) ? -size : size;
  }
  leaf.setValuesOn(); // that flooding leaves it as it is
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

}

openvdb::FloatTree::Ptr UnpackBand(const std::string& bytes, float background)
{
  Counts counts;
  if (bytes.size() < sizeof counts)
  {
    RefuseState();
  }
  const char* from = Read(bytes.data(), 1, &counts);
  CheckCounts(bytes, counts);
  std::vector<LeafBits> leaves(counts.Leaves);
  std::vector<float> magnitudes(counts.Nodes);
  from = Read(from, leaves.size(), leaves.data());
  Read(from, magnitudes.size(), magnitudes.data());
  if (CountActive(leaves) != counts.Nodes)
  {
    RefuseState();
  }
  auto tree = std::make_shared<openvdb::FloatTree>(background);
  const float* magnitude = magnitudes.data();
  const auto leafOf = [&tree](const LeafBits& bits)
  { return tree->touchLeaf(openvdb::Coord(bits.Origin[0], bits.Origin[1], bits.Origin[2])); };
  for (const LeafBits& bits : leaves)
  {
    FillLeaf(bits, background, magnitude, *leafOf(bits));
  }
  openvdb::tools::signedFloodFillWithValues(*tree, background, -background);
  for (const LeafBits& bits : leaves)
  {
    SetActive(bits, *leafOf(bits));
  }
  CheckTree(*tree);
  return tree;
}

}
