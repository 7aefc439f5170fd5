// Writes scan-line files with ZIP or ZIPS compression, in the format of OpenEXR's own writer.
// libdeflate packs with all threads, about twice as fast as the zlib of OpenEXR 3.1, and smaller.
// The bytes do not depend on the number of threads.

#ifndef EXRZip_h
#define EXRZip_h

#include "EXR/EXRPixels.h"
#include "EXR/EXRStreams.h"

#include <ImfHeader.h>

namespace activesurface
{

// Returns true if the header's compression is ZIP or ZIPS.
bool IsZipped(const Imf::Header& header);

// Writes a whole file. The channels are the header's, sorted by name, with rows from below. level:
// effort, 1 to 9. Throws FileError.
void WriteZipped(
  EXROutput& output, Imf::Header header, const std::vector<EXRSamples>& channels, int level);

}

#endif
