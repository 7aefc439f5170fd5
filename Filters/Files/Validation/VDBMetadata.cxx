#include "Validation/VDBMetadata.h"

#include "Validation/ByteSource.h"
#include "Validation/VDBTree.h"

#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

constexpr const char* LeafSizesType = "__delayedload";

/** Validates the bytes that io::DelayedLoadMetadata::readValue reads. */
void ValidateLeafSizes(ByteSource& source, VDBMetadata& metadata)
{
  constexpr std::uint32_t none = 0xffffffff;
  constexpr std::uint64_t leastLeaf = 64; // bytes in a file
  const std::uint64_t count = source.Read<std::uint32_t>();
  if (count > source.GetSize() / leastLeaf)
  {
    RefuseDamage("it lists sizes of more leaves than a file of its size can have");
  }
  const auto walk = [&source](std::uint32_t stored, std::uint64_t bytes)
  {
    if (stored > 0)
    {
      SkipBlosc(source, stored, bytes);
    }
    else
    {
      source.Skip(bytes);
    }
  };
  walk(source.Read<std::uint32_t>(), count * sizeof(std::int8_t));
  const auto stored = source.Read<std::uint32_t>();
  if (stored != none)
  {
    walk(stored, count * sizeof(std::int64_t));
  }
  metadata.HasLeafSizes = true;
  metadata.HasPackedSizes = stored != none;
  metadata.NumberOfLeaves = count;
}

void ValidateValue(ByteSource& source, const std::string& type, VDBMetadata& metadata)
{
  const auto size = source.Read<std::uint32_t>();
  const std::uint64_t begin = source.GetPosition();
  if (type == LeafSizesType && size > 0)
  {
    ValidateLeafSizes(source, metadata);
    if (source.GetPosition() - begin != size)
    {
      RefuseDamage("its list of leaf sizes does not have the length that it declares");
    }
    return;
  }
  // For a registered type of fixed size, OpenVDB reads the size of the type, not that in the file.
  const bool isOfAnySize = type == openvdb::StringMetadata::staticTypeName() ||
    type == LeafSizesType || !openvdb::Metadata::isRegisteredType(type);
  if (!isOfAnySize && openvdb::Metadata::createMetadata(type)->size() != size)
  {
    RefuseDamage("a metadata value has the wrong size");
  }
  if (type == openvdb::BoolMetadata::staticTypeName() && source.Read<std::uint8_t>() > 1)
  {
    RefuseDamage("a metadata value is neither true nor false");
  }
  source.Seek(begin);
  source.Skip(size);
}

}

VDBMetadata ReadMetadata(ByteSource& source)
{
  VDBMetadata metadata;
  const std::uint64_t begin = source.GetPosition();
  const auto count = source.Read<std::uint32_t>();
  for (std::uint32_t i = 0; i < count; ++i)
  {
    source.ReadText();
    const std::string type = source.ReadText();
    ValidateValue(source, type, metadata);
  }
  const std::uint64_t end = source.GetPosition();
  source.Seek(begin);
  std::istringstream bytes(source.ReadBytes(end - begin), std::ios::binary);
  metadata.Values = std::make_shared<openvdb::MetaMap>();
  metadata.Values->readMeta(bytes);
  return metadata;
}

}
