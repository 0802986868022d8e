import { expect, test } from 'vitest';
import { firstView, isSoftware } from './graphics';

test('a renderer without a graphics card is known by its name', () => {
  const swiftShader =
    'ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)), SwiftShader driver)';
  for (const name of [swiftShader, 'llvmpipe (LLVM 15.0.6, 256 bits)', 'softpipe', '', undefined]) {
    expect(isSoftware(name), name).toBe(true);
  }
  for (const name of [
    'ANGLE (Intel, Mesa Intel(R) UHD Graphics 620 (KBL GT2), OpenGL 4.6)',
    'Apple GPU',
    'NVIDIA GeForce RTX 3060/PCIe/SSE2',
    'Adreno (TM) 650',
  ]) {
    expect(isSoftware(name), name).toBe(false);
  }
  expect(isSoftware('ANGLE (Microsoft, Microsoft Basic Render Driver, D3D11)')).toBe(true);
});

test('the plan view is the first one where 3-D would be slow', () => {
  expect(firstView(true)).toBe('plan');
  expect(firstView(false)).toBe('scene');
});
