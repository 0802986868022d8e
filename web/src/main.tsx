// Starts the page.

import { render } from 'solid-js/web';
import { keepFocus } from './app/focus';
import { Page } from './app/Page';
import { carriesToken, takeToken } from './net/loginToken';

// A link to log in with, in a browser that has: nothing of it may stay in the address.
takeToken(window);
// The same link followed in this tab: reload, so that the token disappears from the address.
window.addEventListener('hashchange', (event) => {
  if (!carriesToken(window)) return;
  event.stopImmediatePropagation();
  window.location.reload();
});

const root = document.getElementById('app');
if (!root) throw new Error('index.html has no #app');
keepFocus(document);
render(() => <Page />, root);
