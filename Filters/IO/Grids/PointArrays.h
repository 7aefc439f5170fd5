// Reads the points of a .vdb file as poly data.

#ifndef PointArrays_h
#define PointArrays_h

#include "Base/OpenVDB.h"

#include <cstdint>

class vtkPolyData;

namespace activesurface
{

// Throws std::exception for a grid that is not of points or is damaged, for more points than
// `maximum`, and for an unsupported attribute.
void ReadPoints(const openvdb::GridBase& grid, std::int64_t maximum, vtkPolyData* data);

}

#endif
