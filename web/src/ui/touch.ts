/** The main pointer is a finger: hints name touch, not mouse and keys. */
export const IS_TOUCH = matchMedia('(pointer: coarse)').matches;
