// What is known of a grid in a .vdb file without reading it. Of null, no grid: nothing.

#ifndef GridFacts_h
#define GridFacts_h

#include "VDBFile.h"

#include <string>

namespace activesurface
{

// "level set", "fog volume", ...; "unknown" where the file does not say.
const char* GetGridClass(const VDBGrid* grid);

// First and last active voxel on each axis; 0, -1 if there is none.
void GetActiveBox(const VDBGrid* grid, int box[6]);

void GetVoxelSize(const VDBGrid* grid, double size[3]);

// Of one name as text; empty if there is none. All of them as lines.
std::string GetMetadata(const openvdb::MetaMap* metadata, const std::string& name);
std::string GetAllMetadata(const openvdb::MetaMap* metadata);

}

#endif
