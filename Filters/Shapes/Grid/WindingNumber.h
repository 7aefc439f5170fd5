// Winding number of a mesh around a point, for meshes with holes, too.
//
// A. Jacobson, L. Kavan, O. Sorkine-Hornung, Robust Inside-Outside Segmentation using Generalized
// Winding Numbers, SIGGRAPH 2013; far triangles as dipoles after G. Barill et al., Fast Winding
// Numbers for Soups and Clouds, SIGGRAPH 2018.

#ifndef WindingNumber_h
#define WindingNumber_h

#include "Base/OpenVDB.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

struct MeshTriangles;

class WindingNumber
{
public:
  // The mesh has to outlive this object.
  explicit WindingNumber(const MeshTriangles& mesh);

  // Returns 1 inside a closed mesh, 0 outside, and -1 inside if its polygons face inward. Across a
  // hole the value is a smooth step. Thread-safe; the result does not depend on the number of
  // threads.
  double Evaluate(const openvdb::Vec3d& place) const;

private:
  struct Box
  {
    std::size_t First, Last; // of its triangles, in Order
    std::size_t Next;        // next box that is not inside this one
    openvdb::Vec3d Centre;   // weighted by area
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
  std::vector<Box> Boxes; // each before the boxes inside it
};

}

#endif
