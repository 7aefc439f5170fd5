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

/** Mesh of the triangles. Its normals are those of the points, if there are any. */
Mesh GetMesh(vtkPolyData* triangles);

/** Sum of all counts of MeshDefects. */
std::size_t CountDefects(const Mesh& mesh);

/** "bodies voids Euler-number" of a mesh, or of a row of the history. */
std::string DescribeTopology(const Mesh& mesh);
std::string DescribeTopology(vtkActiveImplicitSurface* filter, int row);

/** Values of the current history. GetNumber throws if the row or the column is missing. */
int CountRows(vtkActiveImplicitSurface* filter);
double GetNumber(vtkActiveImplicitSurface* filter, int row, const char* column);
std::string GetLastEvent(vtkActiveImplicitSurface* filter);

/** All rows before `end`, with enough digits to distinguish any two doubles. */
std::string GetHistoryText(vtkActiveImplicitSurface* filter, int end = 1000000);

}

#endif
