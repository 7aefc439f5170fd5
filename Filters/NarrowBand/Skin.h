/**
 * The surface as triangles: outward, closed, each edge in exactly two of them.
 *
 * One vertex per crossed lattice edge, where the linear interpolation is zero; triangles voxel by
 * voxel (see CubeTriangles.h). Only the band is visited. Vertices and triangles are written in the
 * order of the leaves, so the same potential gives the same bytes.
 */
#ifndef Skin_h
#define Skin_h

#include "ActiveNarrowBandExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

class NarrowBand;

class ACTIVENARROWBAND_EXPORT Skin
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
  /** Triangles of a rank. Of a whole band the ranks have ranges with about as many triangles, of a
   * part a rank has those of its own leaves; those of all ranks one after the other are all. */
  std::vector<TriangleRange> ListTriangles(int rank, int ranks) const;

  /** Number in the skin of all ranks of each vertex; -1 for some that no triangle of this rank has.
   */
  std::vector<std::int64_t> NumberVertices() const;

  /** Whether points in single precision would be off by a hundredth of a voxel, because the surface
   * is that far from the origin. */
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
  std::int64_t FarthestNode = 0; // largest lattice coordinate
  std::size_t NumberOfPoints = 0;
  std::size_t NumberOfTriangles = 0;
  std::vector<std::size_t> FirstTriangle; // per leaf
};

}

#endif
