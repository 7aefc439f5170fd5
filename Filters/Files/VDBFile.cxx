#include "VDBFile.h"

#include "Base/OpenVDB.h"
#include "Validation/ByteSource.h"
#include "Validation/VDBMetadata.h"
#include "Validation/VDBPoints.h"
#include "Validation/VDBTree.h"

#include <openvdb/io/Compression.h>
#include <openvdb/io/DelayedLoadMetadata.h>
#include <openvdb/io/File.h>
#include <openvdb/io/GridDescriptor.h>

#include <cmath>
#include <map>
#include <new>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

/** Opens an openvdb::io::File without delayed loading, so that its grids are independent of the
 * file. The second overload is for versions of OpenVDB whose open() has no parameter. */
template <class File>
auto OpenAtOnce(File& file, int) -> decltype(file.open(false))
{
  return file.open(false);
}

template <class File>
auto OpenAtOnce(File& file, long) -> decltype(file.open())
{
  return file.open();
}

template <class File>
void OpenAtOnce(File& file)
{
  OpenAtOnce(file, 0);
}

constexpr std::uint32_t OldestVersion = openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION;
constexpr const char* HalfSuffix = "_HalfFloat";
constexpr const char* PointsType = "ptdataidx32";

struct KnownType
{
  const char* Name;
  VDBFormat::Leaves Kind;
  std::uint32_t Size, HalfSize;
};

constexpr KnownType KnownTypes[] = { { "float", VDBFormat::Values, 4, 2 },
  { "double", VDBFormat::Values, 8, 2 }, { "int32", VDBFormat::Values, 4, 4 },
  { "int64", VDBFormat::Values, 8, 8 }, { "vec3s", VDBFormat::Values, 12, 6 },
  { "vec3d", VDBFormat::Values, 24, 6 }, { "vec3i", VDBFormat::Values, 12, 12 },
  { "bool", VDBFormat::Bools, 1, 1 }, { "mask", VDBFormat::Masks, 1, 1 },
  { PointsType, VDBFormat::Points, 4, 4 } };

const KnownType* FindType(const std::string& treeType)
{
  for (const KnownType& known : KnownTypes)
  {
    if (treeType == std::string("Tree_") + known.Name + "_5_4_3")
    {
      return &known;
    }
  }
  return nullptr;
}

struct Places
{
  std::uint64_t Grid = 0, End = 0;
};

class FileValidator
{
public:
  FileValidator(const std::string& file, bool trees)
    : Source(file)
    , Trees(trees)
  {
  }

  VDBFile Run();

private:
  void ReadHeader();
  Places ReadDescriptor(VDBGrid& grid);
  void ReadGrid(VDBGrid& grid);
  void ReadTransform(VDBGrid& grid);
  void ValidateTree(VDBGrid& grid, const VDBMetadata& metadata);
  void FindParents(VDBFile& file) const;

  ByteSource Source;
  bool Trees;
  std::uint32_t Version = 0;
  std::uint32_t Compression = 0; //< of the grid
  bool HasPlaces = false;
};

VDBFile FileValidator::Run()
{
  this->ReadHeader();
  VDBFile file;
  file.Metadata = ReadMetadata(this->Source).Values;
  const auto count = this->Source.Read<std::int32_t>();
  if (count < 0)
  {
    RefuseDamage("it has a negative number of grids");
  }
  for (int i = 0; i < count; ++i)
  {
    VDBGrid grid;
    const Places places = this->ReadDescriptor(grid);
    this->ReadGrid(grid);
    if (this->HasPlaces)
    {
      if (this->Trees && this->Source.GetPosition() > places.End)
      {
        RefuseDamage("its grids overlap");
      }
      this->Source.Seek(places.End);
    }
    file.Grids.push_back(grid);
  }
  this->FindParents(file);
  return file;
}

void FileValidator::ReadHeader()
{
  if (this->Source.GetSize() == 0)
  {
    throw std::runtime_error("it is empty");
  }
  if (this->Source.GetSize() < 8 || this->Source.Read<std::int64_t>() != openvdb::OPENVDB_MAGIC)
  {
    throw std::runtime_error("it is no .vdb file");
  }
  this->Version = this->Source.Read<std::uint32_t>();
  if (this->Version < OldestVersion || this->Version > openvdb::OPENVDB_FILE_VERSION)
  {
    throw std::runtime_error("its format has the version " + std::to_string(this->Version) +
      "; only the versions " + std::to_string(OldestVersion) + " to " +
      std::to_string(openvdb::OPENVDB_FILE_VERSION) +
      " can be read; convert the file to one of them");
  }
  this->Source.Skip(2 * sizeof(std::uint32_t)); // version of the library
  this->HasPlaces = this->Source.Read<char>() != 0;
  constexpr int identifier = 36;
  this->Source.Skip(identifier);
}

Places FileValidator::ReadDescriptor(VDBGrid& grid)
{
  grid.UniqueName = this->Source.ReadText();
  grid.Name = openvdb::io::GridDescriptor::nameAsString(grid.UniqueName);
  grid.Type = this->Source.ReadText();
  const std::string suffix = HalfSuffix;
  grid.IsHalf = grid.Type.size() > suffix.size() &&
    grid.Type.compare(grid.Type.size() - suffix.size(), suffix.size(), suffix) == 0;
  grid.Type.resize(grid.Type.size() - (grid.IsHalf ? suffix.size() : 0));
  grid.Parent = this->Source.ReadText();
  Places places;
  places.Grid = this->Source.Read<std::uint64_t>();
  this->Source.Skip(sizeof(std::uint64_t)); // position of the buffers, which follow the topology
  places.End = this->Source.Read<std::uint64_t>();
  if (this->HasPlaces &&
    (places.Grid != this->Source.GetPosition() || places.End < places.Grid ||
      places.End > this->Source.GetSize()))
  {
    RefuseDamage("the offset of a grid is impossible, or the file ends too early");
  }
  return places;
}

void FileValidator::ReadGrid(VDBGrid& grid)
{
  using namespace openvdb::io;
  this->Compression = this->Source.Read<std::uint32_t>();
  if (this->Compression > (COMPRESS_ZIP | COMPRESS_ACTIVE_MASK | COMPRESS_BLOSC))
  {
    RefuseDamage("the grid " + grid.Name + " has an unknown compression");
  }
  const VDBMetadata metadata = ReadMetadata(this->Source);
  grid.Metadata = metadata.Values;
  this->ReadTransform(grid);
  // Validation follows the type, OpenVDB's reader follows the metadata.
  const openvdb::Metadata::ConstPtr half =
    (*grid.Metadata)[openvdb::GridBase::META_SAVE_HALF_FLOAT];
  if ((half && half->asBool()) != grid.IsHalf)
  {
    RefuseDamage("type and metadata of the grid " + grid.Name + " disagree about half floats");
  }
  grid.IsKnown = grid.Transform && FindType(grid.Type) &&
    (std::string(grid.GetValueType()) != "points" ||
      this->Version >= openvdb::OPENVDB_FILE_VERSION_MULTIPASS_IO);
  const bool isSkipped = this->HasPlaces && (!this->Trees || !grid.IsKnown);
  if (!grid.Parent.empty() || isSkipped)
  {
    return;
  }
  if (!grid.IsKnown)
  {
    throw std::runtime_error("its grid " + grid.Name + " has a type (" + grid.Type +
      ") that is not supported in a file of this version, or a transform that is not linear. The "
      "grid cannot be skipped, because the file has no offsets of grids; remove the grid from the "
      "file");
  }
  this->ValidateTree(grid, metadata);
}

void FileValidator::ReadTransform(VDBGrid& grid)
{
  static const std::map<std::string, std::uint64_t> sizes = { { "AffineMap", 128 },
    { "UnitaryMap", 128 }, { "ScaleMap", 120 }, { "UniformScaleMap", 120 },
    { "TranslationMap", 24 }, { "ScaleTranslateMap", 144 }, { "UniformScaleTranslateMap", 144 } };
  const std::uint64_t begin = this->Source.GetPosition();
  const auto size = sizes.find(this->Source.ReadText());
  if (size == sizes.end())
  {
    return; // a perspective map is not linear
  }
  this->Source.Skip(size->second);
  const std::uint64_t end = this->Source.GetPosition();
  this->Source.Seek(begin);
  std::istringstream bytes(this->Source.ReadBytes(end - begin), std::ios::binary);
  grid.Transform = openvdb::math::Transform::createLinearTransform();
  openvdb::io::setCurrentVersion(bytes);
  grid.Transform->read(bytes);
  // Some maps are stored together with their inverse, so a damaged map can contradict its inverse.
  const openvdb::Vec3d node(1.0, 2.0, 3.0);
  const openvdb::Vec3d there = grid.Transform->indexToWorld(node);
  const double miss = (grid.Transform->worldToIndex(there) - node).length();
  const double rounding = 1e-9 * (1.0 + there.length() / grid.Transform->voxelSize().length());
  if (!(miss <= std::max(rounding, 1e-6)))
  {
    RefuseDamage("the transform of the grid " + grid.Name + " cannot be inverted");
  }
}

bool HasTheSizes(const VDBMetadata& metadata, const VDBTree& tree, bool arePacked)
{
  const auto told = metadata.Values->getMetadata<openvdb::io::DelayedLoadMetadata>(
    openvdb::GridBase::META_FILE_DELAYED_LOAD);
  if (!metadata.HasLeafSizes || !told)
  {
    return !metadata.HasLeafSizes && !told;
  }
  bool isSo =
    metadata.NumberOfLeaves == tree.Sizes.size() && (metadata.HasPackedSizes || !arePacked);
  for (std::size_t i = 0; isSo && i < tree.Sizes.size(); ++i)
  {
    isSo = told->getMask(i) == tree.Sizes[i].Scheme &&
      (!metadata.HasPackedSizes || told->getCompressedSize(i) == tree.Sizes[i].Bytes);
  }
  return isSo;
}

void FileValidator::ValidateTree(VDBGrid& grid, const VDBMetadata& metadata)
{
  const KnownType& type = *FindType(grid.Type);
  const VDBFormat format = { type.Kind, type.Size, grid.IsHalf ? type.HalfSize : type.Size,
    this->Compression };
  VDBTree tree = ValidateTopology(this->Source, format);
  if (type.Kind == VDBFormat::Points)
  {
    ValidatePoints(this->Source, tree);
  }
  else
  {
    ValidateBuffers(this->Source, format, tree);
  }
  const bool arePacked =
    this->Compression & (openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ZIP);
  grid.CanBeClipped = type.Kind == VDBFormat::Values && HasTheSizes(metadata, tree, arePacked);
  grid.ActiveVoxels = tree.ActiveVoxels;
  grid.NumberOfLeaves = tree.NumberOfLeaves;
  grid.ActiveBox = tree.ActiveBox;
}

void FileValidator::FindParents(VDBFile& file) const
{
  for (VDBGrid& grid : file.Grids)
  {
    const VDBGrid* parent = nullptr;
    for (const VDBGrid& other : file.Grids)
    {
      parent = other.UniqueName == grid.Parent && other.Parent.empty() ? &other : parent;
    }
    if (grid.Parent.empty())
    {
      continue;
    }
    if (!parent || parent->Type != grid.Type)
    {
      RefuseDamage(
        "the grid " + grid.Name + " shares the tree of a grid that is missing or of another type");
    }
    grid.ActiveVoxels = parent->ActiveVoxels;
    grid.NumberOfLeaves = parent->NumberOfLeaves;
    grid.ActiveBox = parent->ActiveBox;
  }
}

}

const char* VDBGrid::GetValueType() const
{
  const KnownType* known = FindType(this->Type);
  return !known ? this->Type.c_str() : known->Kind == VDBFormat::Points ? "points" : known->Name;
}

VDBFile ValidateVDB(const std::string& file, bool trees)
{
  openvdb::initialize();
  try
  {
    return FileValidator(file, trees).Run();
  }
  catch (const std::bad_alloc&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error("The file " + file + " cannot be read: " + error.what() + ".");
  }
}

openvdb::GridBase::Ptr ReadVDBGrid(
  const std::string& file, const VDBGrid& grid, const openvdb::BBoxd* box)
{
  if (!grid.IsKnown)
  {
    throw std::runtime_error("The grid " + grid.Name + " of the file " + file +
      " cannot be read: " +
      (grid.Transform ? "its type " + grid.Type + " is not supported" +
            (FindType(grid.Type) ? " in a file of this version" : "")
                      : "its transform is not linear") +
      ".");
  }
  try
  {
    openvdb::io::File in(file);
    OpenAtOnce(in);
    return box && grid.CanBeClipped ? in.readGrid(grid.UniqueName, *box)
                                    : in.readGrid(grid.UniqueName);
  }
  catch (const std::bad_alloc&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error("The grid " + grid.Name + " of the file " + file +
      " cannot be read: " + error.what() + "; write the file again.");
  }
}

}
