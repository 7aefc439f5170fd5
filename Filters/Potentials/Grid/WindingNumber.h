// How often a mesh winds around a point, for meshes with holes too.
//
// A. Jacobson, L. Kavan, O. Sorkine-Hornung, Robust Inside-Outside Segmentation using Generalized
// Winding Numbers, SIGGRAPH 2013; far triangles as dipoles after G. Barill et al., Fast Winding
// Numbers for Soups and Clouds, SIGGRAPH 2018.

#ifndef WindingNumber_h
#define WindingNumber_h

#include "OpenVDB.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

struct MeshTriangles;

class WindingNumber
{
public:
  // The mesh has to outlive it.
  explicit WindingNumber(const MeshTriangles& mesh);

  // 1 inside of a closed mesh and 0 outside, -1 inside if its polygons face inward; a smooth step
  // between them across a hole. Thread-safe, and the same on any number of threads.
  double Evaluate(const openvdb::Vec3d& place) const;

private:
  struct Box
  {
    std::size_t First, Last; // of its triangles, in Order
    std::size_t Next;        // box behind all that are within; of a leaf the next one
    openvdb::Vec3d Centre;   // by area
    openvdb::Vec3d Area;     // sum of the area vectors
    double Radius;           // around the centre
  };

  openvdb::Vec3d GetCorner(std::size_t triangle, std::size_t corner) const;
  void Add(std::size_t first, std::size_t last);
  void Measure(Box& box) const;
  double SolidAngle(const openvdb::Vec3d& place, std::size_t triangle) const;

  const MeshTriangles& Mesh;
  std::vector<std::size_t> Order; // of the triangles
  std::vector<openvdb::Vec3d> Middles;
  std::vector<Box> Boxes; // each before those within
};

}

#endif
