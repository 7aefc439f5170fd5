#include "Validation/VDBTree.h"

#include "Base/CompilerBuiltins.h"
#include "Base/OpenVDB.h"
#include "Validation/ByteSource.h"

#include <openvdb/io/Compression.h>

#include <set>
#include <stdexcept>
#include <string>
#include <tuple>

namespace activesurface
{

namespace
{

// Bound on the index coordinates of nodes, far from overflow.
constexpr int Farthest = 1 << 30;

int CountBitsOf(const std::uint64_t* words, int count)
{
  int bits = 0;
  for (int i = 0; i < count; ++i)
  {
    bits += CountBits(words[i]);
  }
  return bits;
}

/** Binary logarithms of the entries (width) and voxels (reach) along a side of a node. Levels: 0
 * leaves of 8^3 voxels, 1 nodes of 16^3 leaves, 2 nodes of 32^3 nodes, 3 the root. */
constexpr int Log2Width[] = { 3, 4, 5 };
constexpr int Log2Reach[] = { 3, 7, 12 };

/** Calls visit(origin) for each entry of a node whose bit in `bits` is set. */
template <class Visitor>
void ForEachEntry(
  int level, const openvdb::Coord& origin, const std::vector<std::uint64_t>& bits, Visitor&& visit)
{
  const int width = Log2Width[level];
  const int reach = Log2Reach[level - 1];
  const int last = (1 << width) - 1;
  for (std::size_t i = 0; i < bits.size(); ++i)
  {
    for (std::uint64_t rest = bits[i]; rest != 0; rest &= rest - 1)
    {
      const int n = 64 * static_cast<int>(i) + LowestBit(rest);
      visit(origin.offsetBy(
        (n >> 2 * width) << reach, ((n >> width) & last) << reach, (n & last) << reach));
    }
  }
}

class TopologyValidator
{
public:
  TopologyValidator(ByteSource& source, const VDBFormat& format, VDBTree& tree)
    : Source(source)
    , Format(format)
    , Tree(tree)
  {
  }

  void Root();
  VDBLeafSize Values(const std::uint64_t* active, int words);

private:
  void Background();
  openvdb::Coord Origin();
  bool IsActive();
  void Node(int level, const openvdb::Coord& origin);
  void Child(int level, const openvdb::Coord& origin);
  void Tile(const openvdb::Coord& origin, int level);
  void Leaf(const openvdb::Coord& origin);
  std::int64_t Data(std::uint64_t bytes);

  ByteSource& Source;
  const VDBFormat& Format;
  VDBTree& Tree;
};

void TopologyValidator::Root()
{
  if (this->Source.Read<std::int32_t>() != 1)
  {
    RefuseDamage("a tree does not have exactly one buffer");
  }
  this->Background();
  const auto tiles = this->Source.Read<std::uint32_t>();
  const auto children = this->Source.Read<std::uint32_t>();
  std::set<std::tuple<int, int, int>> taken;
  for (std::uint64_t i = 0; i < std::uint64_t(tiles) + children; ++i)
  {
    const openvdb::Coord origin = this->Origin();
    if (!taken.emplace(origin.x(), origin.y(), origin.z()).second)
    {
      RefuseDamage("two nodes have the same origin");
    }
    if (i >= tiles)
    {
      this->Node(2, origin);
      continue;
    }
    this->Source.Skip(this->Format.ValueSize);
    if (this->IsActive())
    {
      this->Tile(origin, 2);
    }
  }
}

void TopologyValidator::Background()
{
  const std::string value = this->Source.ReadBytes(this->Format.ValueSize);
  const bool isZero = value.find_first_not_of('\0') == std::string::npos;
  if (this->Format.Kind == VDBFormat::Points && !isZero)
  {
    RefuseDamage(
      "the background of a grid of points is not 0"); // makes OpenVDB's reader abort the program
  }
}

openvdb::Coord TopologyValidator::Origin()
{
  std::int32_t x[3];
  this->Source.Read(x, sizeof x);
  for (const std::int32_t c : x)
  {
    if (c % (1 << Log2Reach[2]) != 0 || c < -Farthest || c >= Farthest)
    {
      RefuseDamage("the origin of a node is impossible");
    }
  }
  return { x[0], x[1], x[2] };
}

bool TopologyValidator::IsActive()
{
  const auto byte = this->Source.Read<std::uint8_t>();
  if (byte > 1)
  {
    RefuseDamage("the active flag of a tile is neither 0 nor 1");
  }
  return byte == 1;
}

void TopologyValidator::Node(int level, const openvdb::Coord& origin)
{
  const int words = 1 << (3 * Log2Width[level] - 6);
  std::vector<std::uint64_t> children(words), active(words);
  this->Source.Read(children.data(), 8 * children.size());
  this->Source.Read(active.data(), 8 * active.size());
  for (int i = 0; i < words; ++i)
  {
    if (children[i] & active[i])
    {
      RefuseDamage("a node is a child and a tile");
    }
  }
  this->Values(active.data(), words);
  ForEachEntry(level, origin, active,
    [this, level](const openvdb::Coord& place) { this->Tile(place, level - 1); });
  ForEachEntry(level, origin, children,
    [this, level](const openvdb::Coord& place) { this->Child(level - 1, place); });
}

void TopologyValidator::Child(int level, const openvdb::Coord& origin)
{
  if (level == 0)
  {
    this->Leaf(origin);
  }
  else
  {
    this->Node(level, origin);
  }
}

void TopologyValidator::Tile(const openvdb::Coord& origin, int level)
{
  const int last = (1 << Log2Reach[level]) - 1;
  this->Tree.ActiveVoxels += std::uint64_t(1) << 3 * Log2Reach[level];
  this->Tree.ActiveTiles += 1;
  this->Tree.ActiveBox.expand(openvdb::CoordBBox(origin, origin.offsetBy(last, last, last)));
}

void TopologyValidator::Leaf(const openvdb::Coord& origin)
{
  VDBTree::Leaf leaf;
  leaf.Origin = origin;
  this->Source.Read(leaf.Active.data(), sizeof leaf.Active);
  this->Tree.Leaves.push_back(leaf);
  this->Tree.NumberOfLeaves += 1;
  for (int x = 0; x < 8; ++x)
  {
    this->Tree.ActiveVoxels += CountBits(leaf.Active[x]);
    for (std::uint64_t rest = leaf.Active[x]; rest != 0; rest &= rest - 1)
    {
      const int n = LowestBit(rest);
      this->Tree.ActiveBox.expand(origin.offsetBy(x, n >> 3, n & 7));
    }
  }
}

/** Validates the bytes that io::readCompressedValues reads. */
VDBLeafSize TopologyValidator::Values(const std::uint64_t* active, int words)
{
  using namespace openvdb::io;
  const auto scheme = this->Source.Read<std::int8_t>();
  if (scheme < NO_MASK_OR_INACTIVE_VALS || scheme > NO_MASK_AND_ALL_VALS)
  {
    RefuseDamage("values have an unknown compression");
  }
  const bool two = scheme == MASK_AND_TWO_INACTIVE_VALS;
  const bool one = scheme == NO_MASK_AND_ONE_INACTIVE_VAL || scheme == MASK_AND_ONE_INACTIVE_VAL;
  this->Source.Skip((two ? 2 : one ? 1 : 0) * std::uint64_t(this->Format.ValueSize));
  if (two || scheme == MASK_AND_ONE_INACTIVE_VAL || scheme == MASK_AND_NO_INACTIVE_VALS)
  {
    this->Source.Skip(8 * std::uint64_t(words));
  }
  const bool isPacked =
    (this->Format.Compression & COMPRESS_ACTIVE_MASK) != 0 && scheme != NO_MASK_AND_ALL_VALS;
  const std::uint64_t count = isPacked ? CountBitsOf(active, words) : 64 * words;
  const bool isHalf = this->Format.StoredSize != this->Format.ValueSize;
  return { scheme, isHalf && count == 0 ? 0 : this->Data(count * this->Format.StoredSize) };
}

std::int64_t TopologyValidator::Data(std::uint64_t bytes)
{
  using namespace openvdb::io;
  if ((this->Format.Compression & (COMPRESS_BLOSC | COMPRESS_ZIP)) == 0)
  {
    this->Source.Skip(bytes);
    return static_cast<std::int64_t>(bytes);
  }
  const auto size = this->Source.Read<std::int64_t>(); // negative: not compressed
  const std::uint64_t stored = size < 0 ? -static_cast<std::uint64_t>(size) : size;
  if (size <= 0 && stored != bytes)
  {
    RefuseDamage("values are missing");
  }
  if (size > 0 && (this->Format.Compression & COMPRESS_BLOSC))
  {
    SkipBlosc(this->Source, stored, bytes);
  }
  else
  {
    this->Source.Skip(stored);
  }
  return static_cast<std::int64_t>(sizeof size + stored);
}

}

VDBTree ValidateTopology(ByteSource& source, const VDBFormat& format)
{
  VDBTree tree;
  TopologyValidator(source, format, tree).Root();
  return tree;
}

void ValidateBuffers(ByteSource& source, const VDBFormat& format, VDBTree& tree)
{
  TopologyValidator validator(source, format, tree);
  for (const VDBTree::Leaf& leaf : tree.Leaves)
  {
    if (source.Read<std::array<std::uint64_t, 8>>() != leaf.Active)
    {
      RefuseDamage("the two masks of a leaf differ");
    }
    if (format.Kind == VDBFormat::Values)
    {
      tree.Sizes.push_back(validator.Values(leaf.Active.data(), 8));
      continue;
    }
    const auto origin = source.Read<std::array<std::int32_t, 3>>();
    if (openvdb::Coord(origin[0], origin[1], origin[2]) != leaf.Origin)
    {
      RefuseDamage("the two origins of a leaf differ");
    }
    source.Skip(format.Kind == VDBFormat::Bools ? 64 : 0);
  }
}

void SkipBlosc(ByteSource& source, std::uint64_t stored, std::uint64_t unpacked)
{
  constexpr std::uint64_t leastPacked = 128;
  struct Header
  {
    std::uint8_t Bytes[4];
    std::uint32_t Unpacked, Block, Stored;
  };
  const std::uint64_t begin = source.GetPosition();
  const auto header = source.Read<Header>();
  const bool isPadded = header.Unpacked == leastPacked && unpacked <= leastPacked;
  if (header.Stored != stored || (header.Unpacked != unpacked && !isPadded))
  {
    RefuseDamage("compressed values have a wrong size");
  }
  source.Seek(begin);
  source.Skip(stored);
}

}
