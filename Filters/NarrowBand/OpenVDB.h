/**
 * OpenVDB, with its templates visible beyond this library, as everything else here is not.
 *
 * OpenVDB's grids keep static members and flags of "called once" in templates. Each program must
 * have one of each: were the members hidden and the flags not, the first library to call would fill
 * its own members alone, and the others would read null. So OpenVDB is included by this header, and
 * before any other header of OpenVDB.
 */
#ifndef OpenVDB_h
#define OpenVDB_h

#pragma GCC visibility push(default)
#include <openvdb/openvdb.h>
#pragma GCC visibility pop

#endif
