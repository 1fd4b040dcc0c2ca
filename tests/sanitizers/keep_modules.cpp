/// Takes the place of the system's `dlclose` in programs that look for leaks: what a graphics
/// driver allocated for good counts as lost once the module that points to it is unloaded.
extern "C" int dlclose(void*) { return 0; }
