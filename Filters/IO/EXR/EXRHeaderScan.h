// Validates the sizes in the headers of an EXR file against the file size before OpenEXR allocates
// memory for them.

#ifndef EXRHeaderScan_h
#define EXRHeaderScan_h

#include "EXR/EXRStreams.h"

#include <ImfForward.h>

namespace activesurface
{

// Reads the headers by OpenEXR's attribute classes, then rewinds the stream. Throws std::exception
// for a file that is not of EXR version 2, has a damaged header, or is too small for its image.
void CheckEXRHeaders(EXRInput& input);

// Returns the unpacked size [bytes] of the lines, or of the tile, that OpenEXR packs at a time. A
// subsampled channel counts as if it had all samples.
double CountBytesOfChunk(const Imf::Header& header);

}

#endif
