/** Panels at which a message can appear. */
export type Place = 'workspace' | 'controller' | 'playback' | 'session' | 'compare' | 'recovery';
