import { readFileSync } from 'node:fs'; import { execSync } from 'node:child_process';
const pid = (p) => execSync(`pgrep -f "bind 127.0.0.1:${p}"`).toString().trim().split('\n')[0];
const rss = (p) => (/RssAnon:\s+(\d+)/.exec(readFileSync(`/proc/${pid(p)}/status`,'utf8'))[1] / 1024).toFixed(1);
const send = async (p, msgs) => { const ws = new WebSocket(`ws://127.0.0.1:${p}/api/sessions/main/live`); await new Promise(r => ws.onopen = r); for (const m of msgs) ws.send(JSON.stringify(m)); return ws; };
for (const p of [7401,7402]) { const ws = await send(p, [{type:'set_goal',x_m:0.12,y_m:-0.33},{type:'run'}]); await new Promise(r=>setTimeout(r,500)); ws.close(); }
for (let i = 0; i < 12; i++) { await new Promise(r=>setTimeout(r,20000)); console.log(i, 'not recorded', rss(7401), 'recorded', rss(7402)); }
