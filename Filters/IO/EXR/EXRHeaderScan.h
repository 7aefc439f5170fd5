// What the headers of an EXR file claim, held against the size of the file before OpenEXR allocates
// what they ask for. It knows the layout of headers, not what the many attributes mean.

#ifndef EXRHeaderScan_h
#define EXRHeaderScan_h

#include "EXR/EXRStreams.h"

namespace activesurface
{

// Throws an FileError with a sentence unless the stream begins with the headers of an EXR file
// whose windows, tiles, tables and attributes could be in a file of its size. Leaves it at its
// beginning.
void CheckEXRHeaders(EXRInput& input);

// In how many lines at a time OpenEXR packs an image of scan lines: one chunk. By the number that
// the header has for the compression.
int CountLinesOfChunk(unsigned compression);

// Whether these are the first bytes of an EXR file.
bool IsEXR(std::istream& stream);

}

#endif
