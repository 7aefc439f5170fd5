// Columns of fits, and their exchange between ranks.

#include "Index/ParallelTasks.h"
#include "Nodes/NodeFits.h"

#include <array>
#include <cmath>

namespace activesurface
{

void NodeFits::Resize(std::size_t count)
{
  this->Row.Build(*this->Blocks);
  for (UnsetVector<float>* numbers : { &this->Wide2, &this->InverseWide2, &this->Bulk })
  {
    numbers->resize(count + LanePadding);
  }
  RunEach(count + LanePadding,
    [this, count](std::size_t k)
    {
      const bool isNeighbour = count > k && this->Given.Strength[k] > 0.f;
      const float wide =
        isNeighbour ? static_cast<float>(this->Options.WidePerReach) * this->Given.Reach[k] : 0.f;
      this->Wide2[k] = wide * wide;
      this->InverseWide2[k] = isNeighbour ? 1.f / (wide * wide) : 0.f;
      this->Bulk[k] = 1.f;
    });
  this->Blocks->FindReaches(
    [this](std::uint32_t k) { return std::sqrt(this->Wide2[k]); }, this->WideReaches);
  const std::size_t near = this->Row.Size();
  for (UnsetVector<float>* numbers : { &this->EX, &this->EY, &this->EZ, &this->EReach2, &this->Deep,
         &this->Thin, &this->Shape, &this->Lone, &this->Share, &this->Lack })
  {
    numbers->resize(near + LanePadding);
  }
  this->Places.resize(6 * near);
  this->Ellipsoids.resize(near);
  RunEach(near + LanePadding,
    [this](std::size_t i)
    {
      this->EX[i] = this->EY[i] = this->EZ[i] = this->EReach2[i] = 0.f;
      this->Share[i] = this->Lack[i] = 0.f;
    });
}

bool NodeFits::FindBox(std::uint32_t k, float (&box)[6]) const
{
  const std::uint32_t row = this->Row[k];
  if (!this->HasRow(k) || !(this->EReach2[row] > 0.f))
  {
    return false;
  }
  const float centre[3] = { this->EX[row], this->EY[row], this->EZ[row] };
  for (int axis = 0; axis < 3; ++axis)
  {
    box[2 * axis] = centre[axis] - this->Ellipsoids[row].Extent[axis];
    box[2 * axis + 1] = centre[axis] + this->Ellipsoids[row].Extent[axis];
  }
  return true;
}

bool NodeFits::FindOutward(std::uint32_t k, float (&outward)[3]) const
{
  const std::uint32_t row = this->Row[k];
  if (!this->HasRow(k) || !(this->Deep[row] > 0.f))
  {
    return false;
  }
  const float* away = &this->Places[6 * row];
  const float length = std::sqrt(away[0] * away[0] + away[1] * away[1] + away[2] * away[2]);
  for (int axis = 0; axis < 3; ++axis)
  {
    outward[axis] = 2.f * this->Given.OwnRadius[k] * away[axis] / length;
  }
  return true;
}

// A ghost near the surface on its owner's rank is near the surface and has a row on this rank, too:
// this rank knows fewer particles, so fewer cells are full.
void NodeFits::ShareShapes()
{
  struct SharedShape
  {
    float Bulk, X, Y, Z, Reach2;
    NodeEllipsoid Ellipsoid;
  };
  this->Ghosts->Share<SharedShape>(
    [this](std::uint32_t k)
    {
      SharedShape shape{};
      shape.Bulk = this->Bulk[k];
      if (this->HasRow(k))
      {
        const std::uint32_t row = this->Row[k];
        shape = { shape.Bulk, this->EX[row], this->EY[row], this->EZ[row], this->EReach2[row],
          this->Ellipsoids[row] };
      }
      return shape;
    },
    [this](std::uint32_t k, const SharedShape& shape)
    {
      this->Bulk[k] = shape.Bulk;
      if (this->HasRow(k))
      {
        const std::uint32_t row = this->Row[k];
        this->EX[row] = shape.X;
        this->EY[row] = shape.Y;
        this->EZ[row] = shape.Z;
        this->EReach2[row] = shape.Reach2;
        this->Ellipsoids[row] = shape.Ellipsoid;
      }
    });
}

void NodeFits::ShareLacks()
{
  this->Ghosts->Share<std::array<float, 2>>(
    [this](std::uint32_t k)
    {
      const std::uint32_t row = this->Row[k];
      return this->HasRow(k) ? std::array<float, 2>{ this->Share[row], this->Lack[row] }
                             : std::array<float, 2>{};
    },
    [this](std::uint32_t k, const std::array<float, 2>& values)
    {
      if (this->HasRow(k))
      {
        this->Share[this->Row[k]] = values[0];
        this->Lack[this->Row[k]] = values[1];
      }
    });
}

void NodeFits::ShareStrengths()
{
  this->Ghosts->Share<float>([this](std::uint32_t k)
    { return this->HasRow(k) ? this->Ellipsoids[this->Row[k]].Strength : 0.f; },
    [this](std::uint32_t k, float strength)
    {
      if (this->HasRow(k))
      {
        this->Ellipsoids[this->Row[k]].Strength = strength;
      }
    });
}

}
