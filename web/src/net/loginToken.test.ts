import { describe, expect, it } from 'vitest';
import { takeToken } from './loginToken';

function at(hash: string): { token: string | undefined; address: string | undefined } {
  let address: string | undefined;
  const token = takeToken({
    location: { hash, pathname: '/s/anna', search: '' },
    history: {
      replaceState: (_state, _title, to) => {
        address = String(to);
      },
    },
  });
  return { token, address };
}

describe('takeToken', () => {
  it('takes the token out of the address', () => {
    expect(at('#token=ab12')).toEqual({ token: 'ab12', address: '/s/anna' });
    expect(at('#token=ab12&v=1&map=colon')).toEqual({
      token: 'ab12',
      address: '/s/anna#v=1&map=colon',
    });
  });

  it('does not change other addresses', () => {
    expect(at('')).toEqual({ token: undefined, address: undefined });
    expect(at('#v=1&map=colon')).toEqual({ token: undefined, address: undefined });
  });
});
