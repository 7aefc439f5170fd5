// Facts of a grid in a .vdb file that are available without reading the grid. A null grid yields an
// empty text, an empty box or 0.

#ifndef GridFacts_h
#define GridFacts_h

#include "VDBFile.h"

#include <string>
#include <vector>

namespace activesurface
{

// Returns the class: "level set", "fog volume" or another; "unknown" if the grid has no class.
const char* GetGridClass(const VDBGrid* grid);

// Returns the time of each file: the metadata "time" of the file, else of the first grid; NaN if
// neither is a floating-point number. Throws std::exception if `files` is empty or a file cannot be
// read.
std::vector<double> ReadTimes(const std::vector<std::string>& files);

// First and last active voxel on each axis; 0, -1 if no voxel is active.
void GetActiveBox(const VDBGrid* grid, int box[6]);

void GetVoxelSize(const VDBGrid* grid, double size[3]);

// Returns the value of a name as text; an empty text if there is no such name.
std::string GetMetadata(const openvdb::MetaMap* metadata, const std::string& name);
// Returns a line of text for each entry.
std::string GetAllMetadata(const openvdb::MetaMap* metadata);

}

#endif
