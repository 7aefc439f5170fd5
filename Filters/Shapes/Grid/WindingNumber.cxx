#include "Grid/WindingNumber.h"

#include "Input/MeshTriangles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace activesurface
{

namespace
{

constexpr std::size_t TrianglesOfLeaf = 8;
// Distance, in radii of a box, beyond which its triangles are one dipole: an error below 1 %.
constexpr double FarInRadii = 2.5;
constexpr double Sphere = 4.0 * 3.14159265358979323846;

}

WindingNumber::WindingNumber(const MeshTriangles& mesh)
  : Mesh(mesh)
  , Order(mesh.Triangles.size())
{
  std::iota(this->Order.begin(), this->Order.end(), std::size_t(0));
  for (std::size_t i = 0; i < this->Order.size(); ++i)
  {
    this->Middles.push_back(
      (this->GetCorner(i, 0) + this->GetCorner(i, 1) + this->GetCorner(i, 2)) / 3.0);
  }
  this->Add(0, this->Order.size());
}

openvdb::Vec3d WindingNumber::GetCorner(std::size_t triangle, std::size_t corner) const
{
  return openvdb::Vec3d(this->Mesh.Points[this->Mesh.Triangles[triangle][corner]].data());
}

void WindingNumber::Add(std::size_t first, std::size_t last)
{
  const std::size_t own = this->Boxes.size();
  this->Boxes.push_back({ first, last, 0, {}, {}, 0.0 });
  this->Measure(this->Boxes.back());
  if (last - first > TrianglesOfLeaf)
  {
    openvdb::BBoxd box;
    for (std::size_t i = first; i < last; ++i)
    {
      box.expand(this->Middles[this->Order[i]]);
    }
    const std::size_t axis = box.maxExtent();
    const std::size_t half = first + (last - first) / 2;
    const auto begin = this->Order.begin();
    std::nth_element(begin + first, begin + half, begin + last,
      [this, axis](std::size_t a, std::size_t b)
      {
        const double x = this->Middles[a][axis], y = this->Middles[b][axis];
        return x < y || (x == y && a < b);
      });
    this->Add(first, half);
    this->Add(half, last);
  }
  this->Boxes[own].Next = this->Boxes.size();
}

void WindingNumber::Measure(Box& box) const
{
  double whole = 0.0;
  for (std::size_t i = box.First; i < box.Last; ++i)
  {
    const std::size_t n = this->Order[i];
    const openvdb::Vec3d a = this->GetCorner(n, 0);
    const openvdb::Vec3d area = 0.5 * (this->GetCorner(n, 1) - a).cross(this->GetCorner(n, 2) - a);
    box.Area += area;
    box.Centre += area.length() * this->Middles[n];
    whole += area.length();
  }
  box.Centre = whole > 0.0 ? box.Centre / whole : this->Middles[this->Order[box.First]];
  for (std::size_t i = box.First; i < box.Last; ++i)
  {
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const double away = (this->GetCorner(this->Order[i], corner) - box.Centre).length();
      box.Radius = std::max(box.Radius, away);
    }
  }
}

// A. van Oosterom, J. Strackee, The Solid Angle of a Plane Triangle, 1983.
double WindingNumber::SolidAngle(const openvdb::Vec3d& place, std::size_t triangle) const
{
  const openvdb::Vec3d a = this->GetCorner(triangle, 0) - place,
                       b = this->GetCorner(triangle, 1) - place,
                       c = this->GetCorner(triangle, 2) - place;
  const double la = a.length(), lb = b.length(), lc = c.length();
  return 2.0 *
    std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

double WindingNumber::Evaluate(const openvdb::Vec3d& place) const
{
  double angle = 0.0;
  for (std::size_t i = 0; i < this->Boxes.size();)
  {
    const Box& box = this->Boxes[i];
    const openvdb::Vec3d away = box.Centre - place;
    const double distance = away.length();
    if (distance > FarInRadii * box.Radius)
    {
      angle += box.Area.dot(away) / (distance * distance * distance);
      i = box.Next;
      continue;
    }
    const bool isLeaf = box.Last - box.First <= TrianglesOfLeaf;
    for (std::size_t n = box.First; isLeaf && n < box.Last; ++n)
    {
      angle += this->SolidAngle(place, this->Order[n]);
    }
    ++i;
  }
  return angle / Sphere;
}

}
