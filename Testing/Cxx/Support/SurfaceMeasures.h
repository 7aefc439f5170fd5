/**
 * Measures of a skin: area, volume, topology, defects, and deviations from a shape.
 */
#ifndef SurfaceMeasures_h
#define SurfaceMeasures_h

#include "Support/AnalyticShapes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{
/** Triangles of a skin in the layout of Skin::Write. */
struct Mesh
{
  std::vector<float> Points;
  std::vector<float> Normals;
  std::vector<std::int64_t> Corners;

  std::size_t GetNumberOfPoints() const { return this->Points.size() / 3; }
  std::size_t GetNumberOfTriangles() const { return this->Corners.size() / 3; }
  Point GetPoint(std::size_t vertex) const;
  Point GetNormal(std::size_t vertex) const;
  /** Vector along the triangle's normal; its length is twice the triangle's area. */
  Point GetAreaVector(std::size_t triangle) const;
};
Mesh Polygonise(const NarrowBand& band);

double GetArea(const Mesh& mesh);
/** Positive if the triangles are counter-clockwise seen from outside. */
double GetVolume(const Mesh& mesh);

/** Violations of a closed oriented manifold; all zero if there are none. */
struct MeshDefects
{
  std::size_t Edges = 0;    //< not traversed exactly once in each direction
  std::size_t Vertices = 0; //< whose triangles do not form one closed fan
  std::size_t Unused = 0;   //< vertices of no triangle
};
MeshDefects FindDefects(const Mesh& mesh);

/** Topology of a closed mesh. Each connected part of the mesh encloses a body or a void. */
struct Topology
{
  int Components = 0;
  int Voids = 0;
  int EulerCharacteristic = 0;
};
Topology GetTopology(const Mesh& mesh);

struct Range
{
  double Mean = 0.0;
  double Minimum = 0.0;
  double Maximum = 0.0;

  double GetSpread() const { return this->Maximum - this->Minimum; }
};
/** Distances of the vertices from a centre. */
Range GetRadii(const Mesh& mesh, const Point& centre);

/** Norm of the potential's gradient, by central differences, where the surface crosses lattice
 * edges; 1 for a distance. */
Range GetSlopes(const NarrowBand& band);

/** Deviation of the skin from a shape: first-order distances [voxels], angles of normals [degrees].
 */
struct Deviation
{
  double MeanDistance = 0.0;
  double LargestDistance = 0.0;
  double MeanAngle = 0.0;
  double LargestAngle = 0.0;
};
Deviation GetDeviation(const Mesh& mesh, const Shape& shape, double voxelSize);

/** Returns true if leaves, masks and values are bitwise identical. Throws std::logic_error for two
 * empty bands, which are no proof. */
bool AreIdentical(const NarrowBand& first, const NarrowBand& second);
}

#endif
