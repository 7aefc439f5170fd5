/**
 * The surface as triangles: closed, oriented outward, each edge in exactly two triangles.
 *
 * Each crossed lattice edge has one vertex, where the linear interpolation is zero, but at least
 * max(2^-13, 2 epsilon N) voxel from the nodes. epsilon is the machine epsilon of the coordinates,
 * N an upper bound of the magnitudes of node coordinates. Triangles are made voxel by voxel (see
 * CubeTriangles.h). Only the band is visited. Vertices and triangles are written in the order of
 * the leaves, so equal potentials give bitwise identical skins.
 */
#ifndef Skin_h
#define Skin_h

#include "ActiveLevelSetExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

class NarrowBand;

class ACTIVELEVELSET_EXPORT Skin
{
public:
  /** Counts vertices and triangles; the band must not change before Write. */
  explicit Skin(const NarrowBand& band);

  std::size_t GetNumberOfPoints() const { return this->NumberOfPoints; }
  std::size_t GetNumberOfTriangles() const { return this->NumberOfTriangles; }

  struct TriangleRange
  {
    std::size_t First;
    std::size_t Last; //< not included
  };
  /** Returns the triangles of a rank. A whole band is divided into ranges with about equally many
   * triangles. If the band is a part, each rank has the triangles of its own leaves. The triangles
   * of all ranks are disjoint, and together they are the whole skin. */
  std::vector<TriangleRange> ListTriangles(int rank, int ranks) const;

  /** Returns the number of each vertex in the skin of all ranks. The number may be -1 for a vertex
   * without a triangle of this rank. */
  std::vector<std::int64_t> NumberVertices() const;

  /** Returns true if the surface is so far from the origin that single precision would move points
   * by about a hundredth of a voxel or more. */
  bool NeedsDoublePrecision() const { return this->FarthestNode > (1 << 17); }

  ///@{
  /**
   * points: 3 numbers per vertex, world coordinates. normals: 3 floats per vertex, outward, unit
   * length, from the gradient of the potential interpolated along the edge; may be null.
   * corners: 3 vertex numbers per triangle, counter-clockwise seen from outside.
   */
  void Write(float* points, float* normals, std::int64_t* corners) const;
  void Write(double* points, float* normals, std::int64_t* corners) const;
  ///@}

private:
  template <class Number>
  void WriteAs(Number* points, float* normals, std::int64_t* corners) const;

  const NarrowBand& Band;
  std::int64_t FarthestNode = 0; // largest magnitude of a leaf's coordinate
  std::size_t NumberOfPoints = 0;
  std::size_t NumberOfTriangles = 0;
  std::vector<std::size_t> FirstTriangle; // of each leaf; the last entry is the total
};

}

#endif
