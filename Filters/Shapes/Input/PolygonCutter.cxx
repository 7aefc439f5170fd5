#include "Input/PolygonCutter.h"

#include "vtkMath.h"

namespace activesurface
{

namespace
{

using Point = PolygonCutter::Point;

Point Between(const Point& from, const Point& to)
{
  Point way;
  vtkMath::Subtract(to.data(), from.data(), way.data());
  return way;
}

// Positive if the triangles abc and acd face the same side.
double SideOf(const Point& a, const Point& b, const Point& c, const Point& d)
{
  const Point diagonal = Between(a, c);
  double first[3], second[3];
  vtkMath::Cross(Between(a, b).data(), diagonal.data(), first);
  vtkMath::Cross(diagonal.data(), Between(a, d).data(), second);
  return vtkMath::Dot(first, second);
}

double SquareBetween(const Point& a, const Point& b)
{
  return vtkMath::Distance2BetweenPoints(a.data(), b.data());
}

}

PolygonCutter::PolygonCutter()
{
  this->Polygon->GetPoints()->SetDataTypeToDouble();
}

const std::vector<PolygonCutter::Triangle>& PolygonCutter::Cut(const std::vector<Point>& corners)
{
  this->Triangles.clear();
  if (corners.size() == 4)
  {
    this->CutQuadrangle(corners);
  }
  else if (corners.size() == 3 || !this->CutByVTK(corners))
  {
    for (std::size_t i = 2; i < corners.size(); ++i)
    {
      this->Triangles.push_back({ 0, i - 1, i });
    }
  }
  return this->Triangles;
}

// Chooses the diagonal independently of the release of VTK. Chooses the diagonal whose two
// triangles face the same side. If this holds for both diagonals or for neither, chooses the
// shorter diagonal, or bd if their lengths are equal.
void PolygonCutter::CutQuadrangle(const std::vector<Point>& corners)
{
  const Point &a = corners[0], &b = corners[1], &c = corners[2], &d = corners[3];
  const double first = SideOf(a, b, c, d), second = SideOf(b, c, d, a);
  const bool isSecond =
    (first > 0.0) != (second > 0.0) ? second > 0.0 : SquareBetween(b, d) <= SquareBetween(a, c);
  const std::size_t start = isSecond ? 1 : 0;
  this->Triangles.push_back({ 0, 1, start + 2 });
  this->Triangles.push_back({ start, 2, 3 });
}

// Returns false if VTK cannot triangulate the polygon.
bool PolygonCutter::CutByVTK(const std::vector<Point>& corners)
{
  const auto count = static_cast<vtkIdType>(corners.size());
  vtkPoints* points = this->Polygon->GetPoints();
  points->SetNumberOfPoints(count);
  this->Polygon->GetPointIds()->SetNumberOfIds(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->SetPoint(i, Between(corners[0], corners[static_cast<std::size_t>(i)]).data());
    this->Polygon->GetPointIds()->SetId(i, i);
  }
  if (!this->Polygon->Triangulate(0, this->Pieces, this->PiecePoints) ||
    this->Pieces->GetNumberOfIds() != 3 * (count - 2))
  {
    return false;
  }
  const auto cornerAt = [this](vtkIdType i)
  { return static_cast<std::size_t>(this->Pieces->GetId(i)); };
  for (vtkIdType i = 0; i < 3 * (count - 2); i += 3)
  {
    this->Triangles.push_back({ cornerAt(i), cornerAt(i + 1), cornerAt(i + 2) });
  }
  return true;
}

}
