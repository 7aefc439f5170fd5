/**
 * What the pipeline's tests read of a skin and of its history.
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

/** Edges and vertices that are not those of a closed manifold, and unused vertices. */
std::size_t CountDefects(const Mesh& mesh);

/** "bodies voids Euler-number": of a mesh, and of a row of the history. */
std::string DescribeTopology(const Mesh& mesh);
std::string DescribeTopology(vtkActiveImplicitSurface* filter, int row);

/** Of the history as it is now. A column that is missing throws. */
int CountRows(vtkActiveImplicitSurface* filter);
double GetNumber(vtkActiveImplicitSurface* filter, int row, const char* column);
std::string GetLastEvent(vtkActiveImplicitSurface* filter);

/** All rows but those from `end` on, with digits enough to tell any two doubles apart. */
std::string GetHistoryText(vtkActiveImplicitSurface* filter, int end = 1000000);

}

#endif
