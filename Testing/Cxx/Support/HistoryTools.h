/**
 * Measures of a skin and values of its history for the pipeline tests.
 */
#ifndef HistoryTools_h
#define HistoryTools_h

#include "Support/SurfaceMeasures.h"

#include <cstddef>
#include <string>

class vtkActiveImplicitSurface;
class vtkPolyData;

namespace activesurface
{

/** Triangles, and their normals if they have any. */
Mesh GetMesh(vtkPolyData* triangles);

/** Number of edges and vertices that violate a closed manifold, and of unused vertices. */
std::size_t CountDefects(const Mesh& mesh);

/** "bodies voids Euler-number" of a mesh, or of a row of the history. */
std::string DescribeTopology(const Mesh& mesh);
std::string DescribeTopology(vtkActiveImplicitSurface* filter, int row);

/** Values of the present history. A missing column throws. */
int CountRows(vtkActiveImplicitSurface* filter);
double GetNumber(vtkActiveImplicitSurface* filter, int row, const char* column);
std::string GetLastEvent(vtkActiveImplicitSurface* filter);

/** All rows before `end`, with enough digits to distinguish any two doubles. */
std::string GetHistoryText(vtkActiveImplicitSurface* filter, int end = 1000000);

}

#endif
