// The rate of a dispatch, where patches have one.
#ifdef LEVELS
uint dispatchRate() { return 1u; } // what asks for it is not called
#else
uint dispatchRate() { return push.rate; }
#endif
