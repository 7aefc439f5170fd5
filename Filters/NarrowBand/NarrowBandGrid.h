/**
 * The potential of a NarrowBand as a grid of OpenVDB, to read and for files.
 */
#ifndef NarrowBandGrid_h
#define NarrowBandGrid_h

#include "NarrowBand.h"
#include "OpenVDB.h"

#include <memory>

namespace activesurface
{

/** u = phi / VoxelSize; active mask = band, the ghosts are inactive values in the same leaves. */
ACTIVENARROWBAND_EXPORT openvdb::FloatGrid::ConstPtr GetPotential(const NarrowBand& band);

///@{
/**
 * The state as a grid for files, without loss: the potential at the active nodes, + or - the
 * background elsewhere, and the other members as metadata (except GetWork). FromGrid throws
 * std::runtime_error for any other grid.
 */
ACTIVENARROWBAND_EXPORT openvdb::FloatGrid::Ptr ToGrid(const NarrowBand& band);
ACTIVENARROWBAND_EXPORT std::unique_ptr<NarrowBand> FromGrid(const openvdb::FloatGrid& grid);
///@}

}

#endif
