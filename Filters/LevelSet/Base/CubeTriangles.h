/**
 * The triangles that separate the inside corners of a voxel from its outside corners, for each of
 * the 256 sign patterns. A triangle is given by three edges of the voxel, because the mesh has one
 * shared vertex on each lattice edge whose ends differ in sign.
 *
 * Over a lattice of any signs, the triangles form a mesh with these properties, except at the
 * boundary of the lattice:
 *  - each mesh edge belongs to exactly two triangles, in opposite directions along the edge,
 *  - the triangles around a vertex form one closed fan,
 *  - triangles are counter-clockwise seen from outside (normals point from inside to outside).
 * The properties hold with ambiguous faces (two diagonally opposite inside corners) too: the inside
 * corners of these faces are always separated. The rule depends only on the signs of the face, so
 * both voxels of a face cut the face in the same way.
 *
 * Numbering. Corner c = 4 x + 2 y + z, the order of an OpenVDB leaf. Edge e = 4 axis + 2 u + v,
 * where u and v are the offsets of the edge along the two other axes, in the order x, y, z.
 */
#ifndef CubeTriangles_h
#define CubeTriangles_h

#include "ActiveLevelSetExport.h"

#include <array>
#include <cstdint>

namespace activesurface
{
constexpr int CornersOfVoxel = 8;
constexpr int EdgesOfVoxel = 12;

/** Lower end of each edge; the upper end is one step further along the edge's axis. */
constexpr std::array<std::uint8_t, EdgesOfVoxel> LowerCornerOfEdge = { 0, 1, 2, 3, 0, 1, 4, 5, 0, 2,
  4, 6 };

/** Position of a corner along an axis (0: x, 1: y, 2: z): 0 or 1. */
constexpr int OffsetOfCorner(int corner, int axis)
{
  return corner >> (2 - axis) & 1;
}

constexpr int AxisOfEdge(int edge)
{
  return edge / 4;
}

constexpr int UpperCornerOfEdge(int edge)
{
  return LowerCornerOfEdge[edge] + (4 >> AxisOfEdge(edge));
}

/** The first Count rows of Edge are triangles. A row consists of three edges of the voxel. */
struct VoxelTriangles
{
  static constexpr int MaximumCount = 5;
  std::uint8_t Count = 0;
  std::uint8_t Edge[MaximumCount][3] = {};
};

/**
 * Returns the triangles of a voxel whose corner c is inside (negative) if bit c of insideBits is
 * set. Range: 0 to 255; higher bits are ignored. Thread-safe; the first call builds the table. The
 * table is contiguous: the result is (&TrianglesOfVoxel(0))[insideBits].
 */
ACTIVELEVELSET_EXPORT const VoxelTriangles& TrianglesOfVoxel(unsigned insideBits);
}

#endif
