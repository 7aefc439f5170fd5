/**
 * The folders of the tests, known to one source only: the others compile alike wherever they lie.
 */
#ifndef TestFolders_h
#define TestFolders_h

/** Testing/Data. */
extern const char* const TestDataFolder;
/** Where tests leave their files. */
extern const char* const TestOutputFolder;

#endif
