#include "SkinParts.h"

#include "NarrowBand.h"
#include "Skin.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace activesurface
{

namespace
{

/** Sets of vertices that triangles connect; a set bears the number of its first vertex. */
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

/** Area, and volume of the cone to a reference point. */
void AddTriangle(const double* const corner[3], const double reference[3], SkinPart& part)
{
  double a[3], b[3], from[3];
  for (int d = 0; d < 3; ++d)
  {
    a[d] = corner[1][d] - corner[0][d];
    b[d] = corner[2][d] - corner[0][d];
    from[d] = corner[0][d] - reference[d];
  }
  const double normal[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0] };
  part.Area +=
    .5 * std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  part.Volume += (from[0] * normal[0] + from[1] * normal[1] + from[2] * normal[2]) / 6.0;
}

/** The triangles of a skin, and the number of the part that each vertex belongs to. */
struct PartedSkin
{
  std::vector<double> Points;
  std::vector<std::int64_t> Corners;
  std::vector<std::size_t> PartOf;
  std::size_t NumberOfParts = 0;

  explicit PartedSkin(const Skin& skin)
    : Points(3 * skin.GetNumberOfPoints())
    , Corners(3 * skin.GetNumberOfTriangles())
    , PartOf(skin.GetNumberOfPoints())
  {
    skin.Write(this->Points.data(), nullptr, this->Corners.data());
    VertexSets sets(this->PartOf.size());
    for (std::size_t c = 0; c < this->Corners.size(); c += 3)
    {
      sets.Join(this->Corners[c], this->Corners[c + 1]);
      sets.Join(this->Corners[c], this->Corners[c + 2]);
    }
    for (std::size_t v = 0; v < this->PartOf.size(); ++v)
    {
      const std::size_t first = static_cast<std::size_t>(sets.Find(static_cast<std::int64_t>(v)));
      this->PartOf[v] = first == v ? this->NumberOfParts++ : this->PartOf[first];
    }
  }
};

/** The block of a vertex: several vertices in a row are in the same one. */
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

}

std::vector<SkinPart> FindSkinParts(const NarrowBand& band)
{
  const PartedSkin skin{ Skin(band) };
  std::vector<SkinPart> parts(skin.NumberOfParts);
  std::vector<std::int64_t> faces(skin.NumberOfParts);
  for (std::size_t v = 0; v < skin.PartOf.size(); ++v)
  {
    SkinPart& part = parts[skin.PartOf[v]];
    ++part.EulerCharacteristic;
    AddBlock(skin.Points.data() + 3 * v, VoxelsOfBlock * band.GetVoxelSize(), part.Blocks);
  }
  for (std::size_t c = 0; c < skin.Corners.size(); c += 3)
  {
    const std::int64_t* corner = skin.Corners.data() + c;
    const double* const at[3] = { skin.Points.data() + 3 * corner[0],
      skin.Points.data() + 3 * corner[1], skin.Points.data() + 3 * corner[2] };
    const std::size_t part = skin.PartOf[corner[0]];
    ++faces[part];
    AddTriangle(at, skin.Points.data(), parts[part]);
  }
  for (std::size_t p = 0; p < parts.size(); ++p)
  {
    // A closed part of F triangles has 3 F / 2 edges: V - E + F.
    parts[p].EulerCharacteristic -= faces[p] / 2;
    std::vector<PartBlock>& blocks = parts[p].Blocks;
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  }
  return parts;
}

}
