// Reads the points of a .vdb file as poly data.

#ifndef PointArrays_h
#define PointArrays_h

#include "Base/OpenVDB.h"

#include <cstdint>

class vtkPolyData;

namespace activesurface
{

// Throws std::invalid_argument for a grid that is not of points. Throws std::runtime_error for more
// points than `maximum`, an unsupported attribute or a damaged grid.
void ReadPoints(const openvdb::GridBase& grid, std::int64_t maximum, vtkPolyData* data);

}

#endif
