// Starts the page.

import './styles/tokens.css';
import './styles/reset.css';
import './ui/controls.css';
import './ui/text.css';
import './ui/panel.css';
import { render } from 'solid-js/web';
import { keepFocus } from './app/focus';
import { DemoPage } from './app/DemoPage';
import { Page } from './app/Page';
import { carriesToken, takeToken } from './net/loginToken';
import { isDemo } from './net/session';

// A login link in a browser that is already logged in: remove the token from the address.
takeToken(window);
// The same link opened in this tab changes only the hash: load the page as if the link was opened in a new tab.
window.addEventListener('hashchange', (event) => {
  if (!carriesToken(window)) return;
  event.stopImmediatePropagation();
  window.location.reload();
});

const root = document.getElementById('app');
if (!root) throw new Error('index.html has no #app');
keepFocus(document);
render(() => (isDemo(window.location) ? <DemoPage /> : <Page />), root);
