// The source of no test: CMake needs one to make the headers that all tests share (see CMakeLists.txt).
