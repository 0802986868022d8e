// Example experiments, as experiment links.

/** Links by name. */
export const PRESETS: Readonly<Record<string, string>> = {
  'Colon, by RL': '#v=1&map=colon&controller=rl&seed=1&start=0.19,-0.28&goal=-0.24,-0.27',
  'The paper’s Example 3: colon, by ERRT, disturbed':
    '#v=1&map=colon&controller=errt&seed=1&start=-0.24,-0.27&goal=0.19,-0.28&script=displace:-0.19,-0.48@near:0.21,-0.34,0.025;displace:-0.24,-0.28@near:0.2,-0.47,0.025',
  'Posts, by attractor':
    '#v=1&map=posts&controller=attractor&seed=1&start=-0.25,-0.37&goal=0.24,-0.36',
  'The wall that traps the literal attractor':
    '#v=1&map=posts&controller=attractor&seed=1&start=-0.05,-0.3&goal=0.13,-0.3&attractor_law=literal',
  'A shaken table, T = 3 cm':
    '#v=1&map=open&controller=attractor&seed=1&start=-0.2,-0.36&goal=0.2,-0.36&threshold_m=0.03&script=impulse:-0.0005,0@step:4;impulse:-0.0005,0@step:10;impulse:-0.0005,0@step:16;impulse:-0.0005,0@step:22',
  'A tracker blind for 6 s':
    '#v=1&map=posts&controller=attractor&seed=1&start=-0.25,-0.37&goal=0.24,-0.36&script=dropout:6@step:13',
  'The literal law, chattering':
    '#v=1&map=posts&controller=attractor&seed=1&start=-0.25,-0.37&goal=0.24,-0.36&switching_law=literal&approach_speed_m_s=0.05&script=displace:-0.14,-0.5@step:14',
  'The paper’s Example 2, on the planar stage':
    '#v=1&map=attractor-example&controller=attractor&seed=1&start=0.72,0.76&goal=-0.77,0.12&transport_speed_m_s=0.076&script=displace:0.42,0.55@passes_x:-0.21',
};
