// The headers of all tests are compiled with this file.
