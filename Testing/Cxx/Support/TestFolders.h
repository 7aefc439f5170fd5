/**
 * Folders of the tests. Only one source contains their paths, so that all others compile alike in
 * any location.
 */
#ifndef TestFolders_h
#define TestFolders_h

/** Testing/Data. */
extern const char* const TestDataFolder;
/** Folder for output files of tests. */
extern const char* const TestOutputFolder;

#endif
