#include "Validation/VDBPoints.h"

#include "Base/OpenVDB.h"
#include "Validation/ByteSource.h"
#include "Validation/VDBMetadata.h"

#include <openvdb/points/AttributeArray.h>
#include <openvdb/points/AttributeGroup.h>

#include <map>
#include <memory>
#include <stdexcept>

namespace activesurface
{

namespace
{

using openvdb::points::AttributeArray;
using Types = std::vector<openvdb::NamePair>;

/** One attribute of the points of one leaf. */
struct Attribute
{
  std::uint64_t Bytes = 0;  //< in memory
  std::uint64_t Stored = 0; //< in the file, if not paged
  bool IsUniform = false;
  bool IsPaged = false;
};

/** Pages of one attribute, which contain the arrays of consecutive leaves. */
class Pages
{
public:
  /** Adds the array of the next leaf, of `bytes` bytes. If the last page is full, reads the size of
   * a new page. */
  void AddSize(ByteSource& source, std::uint64_t bytes)
  {
    if (this->Left == 0)
    {
      const auto stored = source.Read<std::int32_t>();
      const std::int64_t unpacked =
        stored > 0 ? source.Read<std::int32_t>() : -std::int64_t(stored);
      constexpr std::int64_t best = 300; // LZ4 compresses at most 255-fold
      if (stored == 0 || unpacked <= 0 || (stored > 0 && unpacked > best * stored))
      {
        RefuseDamage("a page of attributes has an impossible size");
      }
      this->Sizes.push_back({ stored, unpacked });
      this->Left = static_cast<std::uint64_t>(unpacked);
    }
    if (bytes == 0 || bytes > this->Left)
    {
      RefuseDamage("an attribute does not fit its page");
    }
    this->Left -= bytes;
  }

  void SkipData(ByteSource& source) const
  {
    if (this->Left != 0)
    {
      RefuseDamage("a page of attributes is not full");
    }
    for (const auto& [stored, unpacked] : this->Sizes)
    {
      if (stored > 0)
      {
        SkipBlosc(source, stored, unpacked);
      }
      else
      {
        source.Skip(unpacked);
      }
    }
  }

private:
  std::vector<std::pair<std::int64_t, std::int64_t>> Sizes;
  std::uint64_t Left = 0;
};

class PointsValidator
{
public:
  PointsValidator(ByteSource& source, const VDBTree& tree)
    : Source(source)
    , Tree(tree)
  {
  }

  void Run();

private:
  Types ReadTypes();
  Types ReadDescriptor();
  void ReadNames(std::uint64_t count, std::uint64_t positions);
  std::uint64_t ReadCount(std::uint64_t least);
  Attribute ReadAttribute(const openvdb::NamePair& type);
  void ReadSizes();
  void SkipVoxels();
  void SkipAttributes();

  ByteSource& Source;
  const VDBTree& Tree;
  std::size_t Count = 0;                       //< attributes of each leaf
  Types Shared;                                //< of all leaves, if a leaf declares so
  std::vector<std::vector<Attribute>> PerLeaf; //< by leaf
  std::vector<Pages> PerAttribute;
};

/** Makes the passes over all leaves in the order of PointDataLeafNode::readBuffers. */
void PointsValidator::Run()
{
  const auto passes = this->Source.Read<std::uint16_t>();
  if (passes < 6 || passes % 2 != 0)
  {
    RefuseDamage("points have an impossible number of attributes");
  }
  this->Count = (passes - 4) / 2;
  this->Source.Skip(sizeof(std::uint16_t) * this->Tree.Leaves.size());
  for (std::size_t leaf = 0; leaf < this->Tree.Leaves.size(); ++leaf)
  {
    this->PerLeaf.emplace_back();
    for (const openvdb::NamePair& type : this->ReadTypes())
    {
      this->PerLeaf.back().push_back(this->ReadAttribute(type));
    }
  }
  this->ReadSizes();
  this->SkipVoxels();
  this->SkipAttributes();
}

Types PointsValidator::ReadTypes()
{
  if (!this->Shared.empty())
  {
    return this->Shared;
  }
  const auto flags = this->Source.Read<std::uint8_t>();
  Types types = this->ReadDescriptor();
  if (flags > 3)
  {
    RefuseDamage("points have unknown flags");
  }
  if (flags & 1)
  {
    this->Shared = types;
  }
  if (flags & 2)
  {
    this->Source.Skip(this->Source.Read<std::uint64_t>());
  }
  return types;
}

Types PointsValidator::ReadDescriptor()
{
  Types types(this->ReadCount(2 * sizeof(std::uint32_t)));
  if (types.size() != this->Count)
  {
    RefuseDamage("a leaf does not have as many attributes as the file declares");
  }
  std::size_t groups = 0;
  for (openvdb::NamePair& type : types)
  {
    type.first = this->Source.ReadText();
    type.second = this->Source.ReadText();
    if (!AttributeArray::isRegistered(type))
    {
      throw std::runtime_error("its points have an attribute of an unknown type or codec (\"" +
        type.first + "\", \"" + type.second + "\"); write the file without this attribute");
    }
    groups += type == openvdb::points::GroupAttributeArray::attributeType() ? 1 : 0;
  }
  this->ReadNames(types.size(), types.size());
  this->ReadNames(this->ReadCount(sizeof(std::uint32_t)), 8 * groups);
  ReadMetadata(this->Source);
  return types;
}

void PointsValidator::ReadNames(std::uint64_t count, std::uint64_t positions)
{
  for (std::uint64_t i = 0; i < count; ++i)
  {
    this->Source.ReadText();
    if (this->Source.Read<std::uint64_t>() >= positions)
    {
      RefuseDamage("the index of an attribute is impossible");
    }
  }
}

/** Reads a count of items. Throws if the rest of the file is shorter than count * `least` bytes. */
std::uint64_t PointsValidator::ReadCount(std::uint64_t least)
{
  const auto count = this->Source.Read<std::uint64_t>();
  if (count > this->Source.GetRest() / least)
  {
    RefuseDamage("points have too many attributes");
  }
  return count;
}

/** Validates the bytes that TypedAttributeArray::readMetadata reads. */
Attribute PointsValidator::ReadAttribute(const openvdb::NamePair& type)
{
  constexpr std::uint64_t head = 6; // bytes of the header, included in the stored bytes
  enum
  {
    Strided = 1,
    Uniform = 2,
    Paged = 8,
    AllKnown = 15,
    FlagsOfFiles = 0x1f
  };
  const auto bytes = this->Source.Read<std::uint64_t>();
  const auto flags = this->Source.Read<std::uint8_t>();
  const auto form = this->Source.Read<std::uint8_t>();
  const auto size = this->Source.Read<std::uint32_t>();
  const auto stride = form & Strided ? this->Source.Read<std::uint32_t>() : 1u;
  if (bytes <= head || bytes - head > this->Source.GetSize() * 512 || flags > FlagsOfFiles ||
    form > AllKnown)
  {
    RefuseDamage("an attribute has an impossible size or unknown flags");
  }
  static constexpr std::uint64_t most = std::uint64_t(1) << 31;
  const std::uint64_t each = AttributeArray::create(type, 1, 1)->storageTypeSize();
  const bool isStrideConstant = flags & AttributeArray::CONSTANTSTRIDE;
  const std::uint64_t values = isStrideConstant ? std::uint64_t(size) * stride : stride;
  Attribute attribute;
  attribute.IsUniform = form & Uniform;
  attribute.IsPaged = form & Paged;
  attribute.Bytes = each * (attribute.IsUniform ? 1 : values);
  attribute.Stored = bytes - head;
  if (stride == 0 || values > most || attribute.Bytes > most ||
    (attribute.IsPaged && attribute.Stored != attribute.Bytes))
  {
    RefuseDamage("an attribute has an impossible size");
  }
  return attribute;
}

void PointsValidator::ReadSizes()
{
  this->PerAttribute.resize(this->Count);
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    for (const std::vector<Attribute>& leaf : this->PerLeaf)
    {
      if (leaf[i].IsPaged)
      {
        this->PerAttribute[i].AddSize(this->Source, leaf[i].Bytes);
      }
    }
  }
}

/** Validates the mask of each leaf and skips its table: the end index of each voxel's points. */
void PointsValidator::SkipVoxels()
{
  constexpr std::uint64_t bytes = 512 * sizeof(std::uint32_t);
  constexpr std::uint16_t notPacked = 0xffff;
  for (const VDBTree::Leaf& leaf : this->Tree.Leaves)
  {
    if (this->Source.Read<std::array<std::uint64_t, 8>>() != leaf.Active)
    {
      RefuseDamage("the two masks of a leaf differ");
    }
    const auto stored = this->Source.Read<std::uint16_t>();
    if (stored == notPacked)
    {
      this->Source.Skip(bytes);
    }
    else
    {
      SkipBlosc(this->Source, stored, bytes);
    }
  }
}

void PointsValidator::SkipAttributes()
{
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    this->PerAttribute[i].SkipData(this->Source);
    for (const std::vector<Attribute>& leaf : this->PerLeaf)
    {
      const Attribute& attribute = leaf[i];
      if (attribute.IsPaged)
      {
        continue;
      }
      const bool isPacked = !attribute.IsUniform && this->Source.Read<std::uint8_t>() == 1;
      if (isPacked)
      {
        SkipBlosc(this->Source, attribute.Stored, attribute.Bytes);
      }
      else if (attribute.Stored != attribute.Bytes)
      {
        RefuseDamage("values of an attribute are missing");
      }
      else
      {
        this->Source.Skip(attribute.Stored);
      }
    }
  }
}

}

void ValidatePoints(ByteSource& source, const VDBTree& tree)
{
  if (tree.ActiveTiles > 0)
  {
    RefuseDamage("points have tiles");
  }
  PointsValidator(source, tree).Run();
}

}
