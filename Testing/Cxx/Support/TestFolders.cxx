#include "Support/TestFolders.h"

const char* const TestDataFolder = ACTIVE_TEST_DATA;
const char* const TestOutputFolder = ACTIVE_TEST_OUTPUT;
