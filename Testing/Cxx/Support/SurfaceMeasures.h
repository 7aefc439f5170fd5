/**
 * What the exact tests measure on a skin.
 */
#ifndef SurfaceMeasures_h
#define SurfaceMeasures_h

#include "Support/AnalyticShapes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{
/** The triangles of a skin, as Skin::Write gives them. */
struct Mesh
{
  std::vector<float> Points;
  std::vector<float> Normals;
  std::vector<std::int64_t> Corners;

  std::size_t GetNumberOfPoints() const { return this->Points.size() / 3; }
  std::size_t GetNumberOfTriangles() const { return this->Corners.size() / 3; }
  Point GetPoint(std::size_t vertex) const;
  Point GetNormal(std::size_t vertex) const;
  /** Along the triangle's own normal, as long as twice its area. */
  Point GetAreaVector(std::size_t triangle) const;
};
Mesh Polygonise(const NarrowBand& band);

double GetArea(const Mesh& mesh);
/** Positive when the triangles are counter-clockwise seen from outside. */
double GetVolume(const Mesh& mesh);

/** How a mesh fails to be a closed oriented manifold; all zero if it is one. */
struct MeshDefects
{
  std::size_t Edges = 0;    //< not run through exactly once in each direction
  std::size_t Vertices = 0; //< whose triangles do not form one closed fan
  std::size_t Unused = 0;   //< vertices of no triangle
};
MeshDefects FindDefects(const Mesh& mesh);

/** Of a closed mesh. Each of its parts bounds a body from outside or a void from inside. */
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

/** |gradient| of the potential, by central differences, at the sample points; 1: a distance. */
Range GetSlopes(const NarrowBand& band);

/** How far the skin is from a shape: first-order distances [voxels], angles of normals [degrees].
 */
struct Deviation
{
  double MeanDistance = 0.0;
  double LargestDistance = 0.0;
  double MeanAngle = 0.0;
  double LargestAngle = 0.0;
};
Deviation GetDeviation(const Mesh& mesh, const Shape& shape, double voxelSize);

/** Leaves, masks and values are the same to the bit. Throws std::logic_error for two empty bands,
 * which are no proof. */
bool AreIdentical(const NarrowBand& first, const NarrowBand& second);
}

#endif
